"""Rides by the classical washout."""

from collections.abc import Callable
from math import inf

import numpy as np

from atlas_cueing.cueing import ClassicalParameters
from atlas_cueing.cueing.classical import ClassicalRotation
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    flip_rotation,
    to_euler,
)
from atlas_cueing.rotations import Array
from atlas_cueing.signals import STANDARD_GRAVITY, VehicleState

from .vehicles import LEVEL

Input = Callable[[float], Vec3]

Ride = tuple[Array, Array, Array]

G, DT = STANDARD_GRAVITY, 1.0 / 500.0

FREE = ClassicalParameters(angle_limit=inf)


def ride(
    parameters: ClassicalParameters, rates: Input, forces: Input, seconds: float, dt: float = DT
) -> Ride:
    """Time, angles (roll, pitch, yaw) and w_WS_W for rates and forces over time."""
    method, t, angles, w = (
        ClassicalRotation(dt, parameters),
        dt * np.arange(int(seconds / dt)),
        [],
        [],
    )
    for now in t.tolist():
        q_WS, rate = method.step(VehicleState(now, IDENTITY, rates(now), forces(now)))
        angles.append(angles_of(q_WS))
        w.append(rate)
    return t, np.unwrap(np.array(angles), axis=0), np.array(w)


def angles_of(q_WS: Quat) -> Vec3:
    """Roll, pitch and yaw, FRD."""
    psi, theta, phi = to_euler(flip_rotation(q_WS))
    return phi, theta, psi


def about(axis: int, rate: float) -> Vec3:
    """A rate about one axis alone."""
    w = [0.0, 0.0, 0.0]
    w[axis] = rate
    return w[0], w[1], w[2]


def still(_: float) -> Vec3:
    return ZERO


def level(_: float) -> Vec3:
    return LEVEL
