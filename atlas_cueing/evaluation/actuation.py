"""Lag of the motion behind the cue, limited ticks, and peaks of the actuators."""

from copy import copy

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array, geodesic, length
from .run_columns import RunColumns, Tail
from .statistics import Magnitudes, Peaks, distance

_LARGEST = {
    "wheel_speed_max_rad_s": "wheel_speed",
    "wheel_acceleration_max_rad_s2": "wheel_acceleration",
    "stage_travel_max_m": "motion_p_W",
    "stage_speed_max_m_s": "motion_v_W",
    "stage_acceleration_max_m_s2": "motion_a_W",
}  # figure to column


class Actuation:
    """Effect of smoothing on the cue, and load of the actuators.

    - cue_lag_..._rad, cue_lag_..._m: angle and distance from the cue to the motion, rms and
      maximum;
    - wheels_limited_share, stage_limited_share: share of the ticks at which smoothing could not
      give what was asked;
    - added_..._rms: what smoothing adds to the cue's angular acceleration and stage acceleration
      while no limit is active (at this tick and its neighbours), 0 where there is no such tick:
      chatter shows here. The added angular velocity (W) is differenced, backwards; the added stage
      acceleration (W) is in the log;
    - wheel_..._max, stage_..._max: largest magnitude of any component.
    """

    def __init__(self) -> None:
        """Begin without ticks."""
        self._angle, self._distance = Magnitudes(), Magnitudes()
        self._limited: Array = np.zeros(2)  # ticks, by wheels and by stage
        self._angular, self._linear = _Unlimited(), _Unlimited()
        self._tail = Tail(1)
        self._peaks = {name: Peaks() for name in _LARGEST}

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        self._angle.add(geodesic(block.cue_q_WS, block.motion_q_WS))
        self._distance.add(distance(block.cue_p_W, block.motion_p_W))
        self._limited += np.sum(block.limited, axis=0)
        time, added_w = self._tail.joined(block.time, block.motion_w_W - block.cue_w_W)
        alpha = length(np.diff(added_w, axis=0)) / np.diff(time)
        self._angular.add(alpha, block.limited[:, 0] != 0.0)
        self._linear.add(distance(block.motion_a_W, block.cue_a_W), block.limited[:, 1] != 0.0)
        for name, column in _LARGEST.items():
            self._peaks[name].add(getattr(block, column))

    def figures(self) -> dict[str, float]:
        """Lag, shares, added accelerations and peaks of all blocks so far."""
        wheels, stage = (self._limited / max(self._angle.count, 1)).tolist()
        return {
            "cue_lag_rms_rad": self._angle.rms,
            "cue_lag_max_rad": self._angle.largest,
            "cue_lag_rms_m": self._distance.rms,
            "cue_lag_max_m": self._distance.largest,
            "wheels_limited_share": wheels,
            "stage_limited_share": stage,
            "added_angular_acceleration_rms_rad_s2": self._angular.rms(),
            "added_stage_acceleration_rms_m_s2": self._linear.rms(),
            **{name: peaks.largest for name, peaks in self._peaks.items()},
        }


class _Unlimited:
    """Magnitudes at the ticks at which no limit is active, nor at their neighbours.

    Whether a tick counts is known when the next one has come, so the last one waits.
    """

    def __init__(self) -> None:
        self._free = Magnitudes()
        self._waiting: Array = np.empty(0)  # the value of the last tick
        # a limit, at the tick before the last and at the last one
        self._active: NDArray[np.bool_] = np.zeros(1, np.bool_)

    def add(self, values: Array, active: NDArray[np.bool_]) -> None:
        """Take in the next values (n,), and whether a limit is `active` (n,) at their ticks.

        The first tick of all may have no value: then there is one value less.
        """
        if len(values) < len(active):
            self._active, active = active[:1], active[1:]
        values, active = (
            np.concatenate([self._waiting, values]),
            np.concatenate([self._active, active]),
        )
        self._free.add(values[:-1][~(active[:-2] | active[1:-1] | active[2:])])
        self._waiting, self._active = values[-1:], active[-2:]

    def rms(self) -> float:
        """Root mean square of all values so far, as if no tick came after the last."""
        free = copy(self._free)
        free.add(self._waiting[: 0 if np.any(self._active) else 1])
        return free.rms
