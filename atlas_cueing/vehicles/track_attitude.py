"""How a rider sits on a track: x along it, and banked about that.

Banked by itself, the rider's z is opposite to the force across the track, so that nothing pushes
sideways. Where that force is small, as over a hill, its direction says nothing: the bank then goes
over from one side to the other, by less than a quarter turn, and it is the smoothest (E. Whittaker,
Proceedings of the Edinburgh Mathematical Society 41, 1922), as if bent from steel:

    minimise  sum w_k (b_k - d_k)^2 + L sum (b_(k-1) - 2 b_k + b_(k+1))^2,     w = (f_n / g)^2

A force that turns over sideways, as where a turn ends in a hill, takes the rider over with it.

A given bank is measured from the level, which goes through a loop with the car: bank 0 is a loop
with the head inwards.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline, PchipInterpolator, make_interp_spline
from scipy.linalg import solveh_banded
from scipy.spatial.transform import Rotation

from ..rotation import Vec3, rotate, shortest_arc
from ..rotations import Array, cross, length
from ..signals import STANDARD_GRAVITY
from .track_curve import Way

_WEIGHTLESS = 0.5  # of g: where the force across the track is less, it gives no bank (assumed)
_STIFF = 1.5  # m: bends of the bank over less than 2 pi times this are smoothed out (assumed)
_MOST = 2.0  # of g: more force does not bend the bank more (assumed)
_FAINT = 1e-6  # weight of a bridged angle, so that there always is an answer
_BEND = (1.0, -2.0, 1.0)
_UPRIGHT = 0.1  # sine of the angle to the vertical: where it is less, there is no level


def attitude_along(way: Way, across: Array, bank: Array | None) -> BSpline:
    """Return q_NB as a curve over u, of unit length within its error.

    across: force across the track (n, 3), m/s^2, N. bank: (n,) rad; None for no side force.
    """
    sides, downs = _carried(way.tangent)
    if bank is None:
        right = cross(-across, way.tangent)
        certain = length(across) > _WEIGHTLESS * STANDARD_GRAVITY
    else:
        right = cross(np.broadcast_to([0.0, 0.0, 1.0], way.tangent.shape), way.tangent)
        certain = length(right) > _UPRIGHT
    angle = np.arctan2(np.einsum("ij,ij->i", right, downs), np.einsum("ij,ij->i", right, sides))
    angle = _between(way.u, angle, certain)
    if bank is None:
        weights = np.where(certain, np.minimum(length(across) / STANDARD_GRAVITY, _MOST) ** 2, 0.0)
        angle = _smooth(angle, weights, (_STIFF / float(way.u[1] - way.u[0])) ** 4)
    else:
        angle = angle + bank
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    axes = np.stack([way.tangent, c * sides + s * downs, c * downs - s * sides], axis=2)
    q = np.roll(Rotation.from_matrix(axes).as_quat(), 1, axis=1)
    flips = np.concatenate([[False], np.einsum("ij,ij->i", q[1:], q[:-1]) < 0.0])
    return make_interp_spline(way.u, q * np.where(np.cumsum(flips) % 2, -1.0, 1.0)[:, None], k=5)


def _carried(tangent: Array) -> tuple[Array, Array]:
    """Carry a side and a down along the track without turning them about it, from step to step."""
    first = tangent[0]
    side = np.cross([0.0, 0.0, 1.0] if abs(first[2]) < 0.9 else [1.0, 0.0, 0.0], first)
    x, y, z = (side / np.linalg.norm(side)).tolist()
    carried: list[Vec3] = [(x, y, z)]
    rows: list[Vec3] = [(a, b, c) for a, b, c in tangent.tolist()]
    for k in range(1, len(rows)):
        carried.append(rotate(shortest_arc(rows[k - 1], rows[k]), carried[-1]))
    sides = np.array(carried)
    sides -= tangent * np.einsum("ij,ij->i", sides, tangent)[:, None]
    sides /= length(sides)[:, None]
    return sides, cross(tangent, sides)


def _between(u: Array, angle: Array, certain: NDArray[np.bool_]) -> Array:
    """Return angles that go on by less than a quarter turn, bridged where they are not certain."""
    if np.count_nonzero(certain) < 2:
        return np.zeros(len(u))
    known = u[certain]
    going_on = np.unwrap(angle[certain], period=np.pi)
    bridged: Array = PchipInterpolator(known, going_on)(np.clip(u, known[0], known[-1]))
    bridged[certain] = going_on
    return bridged


def _smooth(angle: Array, weights: Array, stiffness: float) -> Array:
    """Return the smoothest angles that keep to those of some weight: a system of five diagonals."""
    size = len(angle)
    bands = np.zeros((3, size))
    for row, one in enumerate(_BEND):
        for other in range(row, len(_BEND)):
            shift = other - row
            bands[2 - shift, other : size - 2 + other] += stiffness * one * _BEND[other]
    bands[2] += weights + _FAINT
    smooth: Array = solveh_banded(bands, (weights + _FAINT) * angle)
    return smooth
