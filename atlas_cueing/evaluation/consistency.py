"""Can the log be trusted? The wheels are derived from the motion again, and the orientation from the wheels alone."""

import numpy as np
from numpy.typing import ArrayLike

from ..rotations import Array, accumulated, cross, exp, geodesic
from .run_columns import RunColumns, Tail, gathered
from .statistics import Peaks


class Consistency:
    """How well the logged quantities agree with each other, block by block."""

    def __init__(self, wheels_from_sphere: ArrayLike, sphere_from_wheels: ArrayLike) -> None:
        """Of no ticks yet; the matrices are those of `consistency`."""
        self._from_sphere = np.asarray(wheels_from_sphere, dtype=np.float64).T
        self._course = _Course(sphere_from_wheels)
        self._speed, self._acceleration = Peaks(), Peaks()
        self._final, self._largest = 0.0, 0.0

    def add(self, block: RunColumns) -> None:
        """Take in the ticks that follow."""
        self._speed.add(block.wheel_speed - block.motion_w_W @ self._from_sphere)
        self._acceleration.add(block.wheel_acceleration - block.motion_alpha_W @ self._from_sphere)
        drift = geodesic(self._course.orientations(block), block.motion_q_WS)
        self._final, self._largest = (
            float(drift[-1]),
            float(np.maximum(self._largest, np.max(drift))),
        )

    def figures(self) -> dict[str, float]:
        """Those of `consistency`."""
        return {
            "wheel_speed_mismatch_max_rad_s": self._speed.largest,
            "wheel_acceleration_mismatch_max_rad_s2": self._acceleration.largest,
            "orientation_drift_final_rad": self._final,
            "orientation_drift_max_rad": self._largest,
        }


def consistency(
    flight: RunColumns, wheels_from_sphere: ArrayLike, sphere_from_wheels: ArrayLike
) -> dict[str, float]:
    """How well the logged quantities agree with each other.

    - wheel_speed_mismatch_max_rad_s, wheel_acceleration_mismatch_max_rad_s2: logged against J^-1
        times the logged motion;
    - orientation_drift_final_rad, orientation_drift_max_rad: `reintegrate` against the logged q_WS.

    The matrices are (3, 3): wheel speeds = wheels_from_sphere @ w_WS_W (J^-1, Eq. 22), and back (J,
    Eq. 18).
    """
    return gathered(Consistency(wheels_from_sphere, sphere_from_wheels), flight)


def reintegrate(flight: RunColumns, sphere_from_wheels: ArrayLike) -> Array:
    """Orientations (n, 4) from the first one and the wheels alone, q' = 1/2 Omega o q with Omega = J omega (Eq. 18, 20).

    The turn over a tick is the integral of the cubic through the logged speeds and accelerations at
    its ends, plus the
    Magnus commutator of `rotation.integrate_base`: fourth order in the step.
    """
    course = _Course(sphere_from_wheels)
    return np.concatenate([np.empty((0, 4)), *map(course.orientations, flight.blocks())])


class _Course:
    """The orientation as the wheels alone turn it on, block by block."""

    def __init__(self, sphere_from_wheels: ArrayLike) -> None:
        self._to_sphere = np.asarray(sphere_from_wheels, dtype=np.float64).T
        self._tail = Tail(1)
        self._last: Array | None = None

    def orientations(self, block: RunColumns) -> Array:
        """At the ticks that follow, (n, 4)."""
        time, speed, acceleration = self._tail.joined(
            block.time, block.wheel_speed, block.wheel_acceleration
        )
        turns = _turns(np.diff(time), speed @ self._to_sphere, acceleration @ self._to_sphere)
        if self._last is None:
            course = accumulated(block.motion_q_WS[0], turns)
        else:
            course = accumulated(self._last, turns)[1:]
        self._last = course[-1].copy()
        return course


def _turns(h: Array, w: Array, alpha: Array) -> Array:
    """Quaternions (n - 1, 4) of the turns over steps h (n - 1,), s, from rates and accelerations (n, 3) at their ends."""
    h = h[:, None]
    slowing = alpha[:-1] - alpha[1:]
    return exp(0.5 * h * (w[:-1] + w[1:]) + h * h / 12.0 * (slowing + cross(w[1:], w[:-1])))
