"""Axes of others, turned into ours: body forward-right-down, world north-east-down.

With q_FRD_FLU half a turn about x, and q_NED_ENU half a turn about (1, 1, 0) / sqrt 2:

    q_NED_FRD = q_NED_world q_world_body q_body_FRD
"""

from typing import Final

import numpy as np

from ..rotations import Array, length, multiply
from .flight_map import AttitudeTable

_HALF = np.sqrt(0.5)
_TURN_X = np.array([0.0, 1.0, 0.0, 0.0])
_FROM_WORLD: Final = {
    "NED": np.array([1.0, 0.0, 0.0, 0.0]),
    "ENU": np.array([0.0, _HALF, _HALF, 0.0]),
    "NWU": _TURN_X,
}
_TO_BODY: Final = {"FRD": np.array([1.0, 0.0, 0.0, 0.0]), "FLU": _TURN_X}
_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])
OF_WORLD: Final = ("NED", "ENU")


def attitude(values: Array, table: AttitudeTable, factors: Array) -> Array:
    """Return q_NB (n, 4) of an attitude as the file has it, its sign continuous.

    values: (n, 4) w, x, y, z; or (n, 3) roll, pitch, yaw, which `factors` (3,) turn into rad: yaw
    about z, then pitch about y, then roll about x, of its own axes.
    """
    if table.kind == "quaternion":
        own = values / np.maximum(length(values), 1e-300)[:, None]
    else:
        own = _from_euler(values * factors)
    if table.inverse:
        own = own * _CONJUGATE
    return continuous(
        multiply(multiply(_FROM_WORLD[table.world], own), _CONJUGATE * _TO_BODY[table.frame])
    )


def in_body(values: Array, frame: str) -> Array:
    """Return vectors (n, 3) of the body's axes `frame` in FRD."""
    return values * np.array([1.0, -1.0, -1.0]) if frame == "FLU" else values


def in_world(values: Array, frame: str) -> Array:
    """Return vectors (n, 3) of the world's axes `frame` in NED."""
    if frame == "ENU":
        return np.column_stack([values[:, 1], values[:, 0], -values[:, 2]])
    return values


def continuous(q: Array) -> Array:
    """Return quaternions (n, 4) with the sign of each next to that of the one before."""
    flips = np.einsum("ij,ij->i", q[1:], q[:-1]) < 0.0
    signs = np.concatenate([[1.0], np.where(np.cumsum(flips) % 2, -1.0, 1.0)])
    signed: Array = q * signs[:, None]
    return signed


def _from_euler(angles: Array) -> Array:
    """Return quaternions of roll, pitch, yaw (n, 3), rad."""
    half = 0.5 * angles
    zero = np.zeros(len(angles))
    about = [np.column_stack(_about(half[:, axis], axis, zero)) for axis in range(3)]
    return multiply(multiply(about[2], about[1]), about[0])


def _about(half: Array, axis: int, zero: Array) -> list[Array]:
    components = [np.cos(half), zero, zero, zero]
    components[axis + 1] = np.sin(half)
    return components
