"""Were the actuators' limits kept? By the logged values, and by finite differences of them."""

import numpy as np

from ..rotations import Array
from ..signals import StageLimits, WheelLimits
from .run_columns import RunColumns, Tail, gathered
from .statistics import Peaks

# of a limit: differences over 1 ms of times up to an hour carry rounding of 1e-9, resting on a
# limit is fair
TOLERANCE = 1e-6


class LimitUse:
    """Use of the limits, block by block."""

    def __init__(self, wheels: WheelLimits, stage: StageLimits) -> None:
        """Of no ticks yet."""
        self._limits = {
            "wheel_speed_logged": wheels.speed,
            "wheel_acceleration_logged": wheels.acceleration,
            "wheel_acceleration_difference": wheels.acceleration,
            "wheel_jerk_difference": wheels.jerk,
            "wheel_jerk_second_difference": wheels.jerk,
            "stage_travel_logged": stage.travel,
            "stage_speed_logged": stage.speed,
            "stage_speed_difference": stage.speed,
            "stage_acceleration_logged": stage.acceleration,
            "stage_acceleration_difference": stage.acceleration,
            "stage_jerk_difference": stage.jerk,
        }
        self._peaks = {name: Peaks() for name in self._limits}
        self._tail = Tail(2)

    def add(self, block: RunColumns) -> None:
        """Take in the ticks that follow."""
        t, speed, acceleration, p, v, a = self._tail.joined(
            block.time,
            block.wheel_speed,
            block.wheel_acceleration,
            block.motion_p_W,
            block.motion_v_W,
            block.motion_a_W,
        )
        dt = np.diff(t)
        wheel_slope = _slope(speed, dt)
        used = {
            "wheel_speed_logged": speed,
            "wheel_acceleration_logged": acceleration,
            "wheel_acceleration_difference": wheel_slope,
            "wheel_jerk_difference": _slope(acceleration, dt),
            "wheel_jerk_second_difference": _slope(wheel_slope, 0.5 * (t[2:] - t[:-2])),
            "stage_travel_logged": p,
            "stage_speed_logged": v,
            "stage_speed_difference": _slope(p, dt),
            "stage_acceleration_logged": a,
            "stage_acceleration_difference": _slope(v, dt),
            "stage_jerk_difference": _slope(a, dt),
        }
        for name, values in used.items():
            self._peaks[name].add(values)

    def figures(self) -> dict[str, float]:
        """Those of `limit_use`."""
        return {
            name: float(np.max(self._peaks[name].components / limit))
            for name, limit in self._limits.items()
        }


def limit_use(flight: RunColumns, wheels: WheelLimits, stage: StageLimits) -> dict[str, float]:
    """Largest use of each limit over the flight and over wheels or axes, as a fraction of the limit.

    `..._logged` is the quantity in the log; `..._difference` the slope of the next lower one
    between two ticks, which the mean of the true quantity over the tick equals;
    `..._second_difference` the curvature of the speed over three ticks: its second divided
        difference times two, the mean second derivative weighted by a hat.
    """
    return gathered(LimitUse(wheels, stage), flight)


def violations(use: dict[str, float], tolerance: float = TOLERANCE) -> list[str]:
    """One line for each limit that was exceeded, or that is not a number.

    Empty when all were kept.
    """
    # NaN too
    exceeded = {name: value for name, value in use.items() if not value <= 1.0 + tolerance}
    return [
        f"{name} = {value:.9g} of the limit, allowed: at most 1" for name, value in exceeded.items()
    ]


def _slope(values: Array, dt: Array) -> Array:
    """Slope (n - 1, 3) between rows of values (n, 3) that are dt (n - 1,) apart."""
    return np.diff(values, axis=0) / dt[:, None]
