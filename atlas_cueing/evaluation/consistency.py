"""Whether a log can be trusted: do its wheels, its motion and its orientation agree?

The wheels are derived from the motion again, and the orientation from the wheels alone.
"""

import numpy as np
from numpy.typing import ArrayLike

from ..rotations import Array, accumulated, cross, exp, geodesic
from .run_columns import RunColumns, Tail
from .statistics import Peaks


class Consistency:
    """How well the logged quantities agree with each other.

    - wheel_speed_residual_max_rad_s, wheel_acceleration_residual_max_rad_s2: logged wheels against
      J^-1 (Eq. 22) times the logged motion, w_WS and alpha in W;
    - orientation_drift_final_rad, orientation_drift_max_rad: angle between the logged q_WS and the
      orientation that the wheels alone make of the first one, by q' = 1/2 Omega o q with
      Omega = J omega (Eq. 18, 20).
    """

    def __init__(self, wheels_from_sphere: ArrayLike, sphere_from_wheels: ArrayLike) -> None:
        """Begin without ticks.

        The matrices are (3, 3): wheel speeds = wheels_from_sphere @ w_WS_W (J^-1, Eq. 22), and back
        by sphere_from_wheels (J, Eq. 18).
        """
        self._from_sphere = np.asarray(wheels_from_sphere, dtype=np.float64).T
        self._reintegration = _Reintegration(sphere_from_wheels)
        self._speed, self._acceleration = Peaks(), Peaks()
        self._final, self._largest = 0.0, 0.0

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        self._speed.add(block.wheel_speed - block.motion_w_W @ self._from_sphere)
        self._acceleration.add(block.wheel_acceleration - block.motion_alpha_W @ self._from_sphere)
        drift = geodesic(self._reintegration.orientations(block), block.motion_q_WS)
        self._final, self._largest = (
            float(drift[-1]),
            float(np.maximum(self._largest, np.max(drift))),
        )

    def figures(self) -> dict[str, float]:
        """Residuals and drift of all blocks so far."""
        return {
            "wheel_speed_residual_max_rad_s": self._speed.largest,
            "wheel_acceleration_residual_max_rad_s2": self._acceleration.largest,
            "orientation_drift_final_rad": self._final,
            "orientation_drift_max_rad": self._largest,
        }


class _Reintegration:
    """Orientations from the first one and the wheels alone, block by block.

    The turn over a tick is the integral of the cubic through the logged speeds and accelerations at
    its ends, plus the Magnus commutator of `rotation.integrate_base`: fourth order in the step.
    """

    def __init__(self, sphere_from_wheels: ArrayLike) -> None:
        self._to_sphere = np.asarray(sphere_from_wheels, dtype=np.float64).T
        self._tail = Tail(1)
        self._last: Array | None = None

    def orientations(self, block: RunColumns) -> Array:
        """Orientations q_WS (n, 4) at the next ticks."""
        time, speed, acceleration = self._tail.joined(
            block.time, block.wheel_speed, block.wheel_acceleration
        )
        turns = _turns(np.diff(time), speed @ self._to_sphere, acceleration @ self._to_sphere)
        if self._last is None:
            q_WS = accumulated(block.motion_q_WS[0], turns)
        else:
            q_WS = accumulated(self._last, turns)[1:]
        self._last = q_WS[-1].copy()
        return q_WS


def _turns(h: Array, w: Array, alpha: Array) -> Array:
    """Quaternions (n - 1, 4) of the turns over the steps h (n - 1,), s.

    w, alpha: rates (rad/s) and accelerations (rad/s^2) at the ticks, (n, 3), W.
    """
    h = h[:, None]
    slowing = alpha[:-1] - alpha[1:]
    return exp(0.5 * h * (w[:-1] + w[1:]) + h * h / 12.0 * (slowing + cross(w[1:], w[:-1])))
