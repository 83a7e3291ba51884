"""Whether the actuators' limits were kept, by the logged values and by their differences."""

import re
from collections.abc import Mapping

import numpy as np

from ..rotations import Array
from ..signals import StageLimits, WheelLimits
from .run_columns import RunColumns, Tail
from .statistics import Peaks

# of a limit: differences over 1 ms of times up to an hour carry rounding of 1e-9, resting on a
# limit is fair
TOLERANCE = 1e-6
_HOW = re.compile("_(logged|difference|second_difference)$")  # behind the limit in a name


class LimitUse:
    """Largest use of each limit over a run and over wheels or axes, as a fraction of the limit.

    - ..._logged: by the quantity in the log;
    - ..._difference: by the slope of the next lower one between two ticks, which is the mean of the
      true quantity over the tick;
    - ..._second_difference: by the curvature of the speed over three ticks, its second divided
      difference times two: the mean second derivative weighted by a hat.
    """

    def __init__(self, wheels: WheelLimits, stage: StageLimits) -> None:
        """Begin without ticks; the limits are those of each wheel and of each axis of the stage."""
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
        """Take in the next ticks."""
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
        """Largest use of each limit in all blocks so far, 1 for the limit itself."""
        return {
            name: float(np.max(self._peaks[name].components / limit))
            for name, limit in self._limits.items()
        }


def by_limit(use: Mapping[str, float]) -> dict[str, float]:
    """Largest use of each limit, whether by logged values or by their differences."""
    most: dict[str, float] = {}
    for name, value in use.items():
        limit = _HOW.sub("", name)
        most[limit] = max(most.get(limit, value), value)
    return most


def violations(use: dict[str, float], tolerance: float = TOLERANCE) -> list[str]:
    """List the limits that were exceeded, or whose use is not a number, one line each.

    use: as `LimitUse.figures` gives it; tolerance: fraction of a limit that is not counted.
    """
    # NaN too
    exceeded = {name: value for name, value in use.items() if not value <= 1.0 + tolerance}
    return [
        f"{name} = {value:.9g} of the limit, allowed: at most 1" for name, value in exceeded.items()
    ]


def _slope(values: Array, dt: Array) -> Array:
    """Slopes (n - 1, 3) between the rows of values (n, 3), dt (n - 1,) apart."""
    return np.diff(values, axis=0) / dt[:, None]
