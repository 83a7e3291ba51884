"""Smooth motion that is known at any time, and samples of it."""

from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from atlas_cueing.rotation import IDENTITY, Quat, Vec3, add, integrate_body, normalise, scale
from atlas_cueing.signals import VehicleState

FINE = 1e-3  # s; the attitude is integrated to 1e-12 rad in such steps

Array = NDArray[np.float64]


def rate(t: float) -> Vec3:
    """Body rates of a lively flight, up to 1 Hz, rad/s."""
    return (0.8 * sin(2.0 * pi * t), 0.3 + 0.4 * sin(3.1 * t + 1.0), 0.25 * cos(4.3 * t))


def force(t: float) -> Vec3:
    """Specific force that swings by 6 m/s^2, up to 1 Hz."""
    return (1.5 * sin(2.3 * t), 2.0 * sin(2.0 * pi * t + 0.5), -9.80665 + 6.0 * sin(3.0 * t))


class Motion:
    """The motion from 0 to `duration` (s)."""

    def __init__(self, duration: float) -> None:
        self._grid: list[Quat] = [IDENTITY]
        for k in range(int(duration / FINE) + 1):
            self._grid.append(self._on(self._grid[-1], k * FINE, FINE))

    def at(self, time: float) -> VehicleState:
        """State at any time."""
        k = int(time / FINE)
        return VehicleState(
            time, self._on(self._grid[k], k * FINE, time - k * FINE), rate(time), force(time)
        )

    @staticmethod
    def _on(q: Quat, t: float, h: float) -> Quat:
        """Simpson's rule and the Magnus expansion."""
        w0, w1 = rate(t), rate(t + h)
        turn = scale(h / 6.0, add(add(w0, w1), scale(4.0, rate(t + 0.5 * h))))
        return normalise(integrate_body(q, turn, w0, w1, h))


def rms(values: Array) -> float:
    """Root of the mean squared length of the rows."""
    return float(np.sqrt(np.mean(np.sum(np.square(values), axis=-1))))


def angles(one: list[VehicleState], other: list[VehicleState]) -> Array:
    """Angle between attitudes, rad, with scipy."""
    from scipy.spatial.transform import Rotation

    p, q = (
        Rotation.from_quat([state.q_NB for state in states], scalar_first=True)
        for states in (one, other)
    )
    magnitude: Array = (p.inv() * q).magnitude()
    return magnitude


def rates(states: list[VehicleState]) -> Array:
    return np.array([state.w_NB_B for state in states])


def forces(states: list[VehicleState]) -> Array:
    return np.array([state.f_B for state in states])


def turned_rates(states: list[VehicleState]) -> Array:
    """Body rates from differences of the attitude alone, rad/s, between neighbours."""
    from scipy.spatial.transform import Rotation

    q = Rotation.from_quat([state.q_NB for state in states], scalar_first=True)
    h = np.diff([state.time for state in states])
    turned: Array = (q[:-1].inv() * q[1:]).as_rotvec() / h[:, None]
    return turned
