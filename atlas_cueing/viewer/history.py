"""The history that a live page keeps: the last tick, and the last seconds thinned for plots."""

from collections import deque
from collections.abc import Sequence

import numpy as np

from ..recording.chunk import felt_columns
from ..rotation import Vec3
from ..rotations import Array
from ..signals import LIVE_ROW, LIVE_TOPICS
from .live_plots import Traces
from .recorded_motion import wheel_angles
from .scene import Pose

SPAN = 20.0  # s; of the plots
STEP = 0.05  # s; from point to point


def columns(topic: str, first: str, count: int = 1) -> slice:
    """Return the columns of `count` fields of a topic in `signals.live_row`, from `first` on."""
    start = 0
    for each in LIVE_TOPICS:
        if each.name == topic:
            start += each.fields.index(first)
            return slice(start, start + count)
        start += len(each.fields)
    raise ValueError(f"topic {topic!r}, allowed: {', '.join(each.name for each in LIVE_TOPICS)}")


_TIME = columns("/motion", "time_s").start
_Q, _P = columns("/motion", "q_ws_w", 4), columns("/motion", "px_m", 3)
_PILOT_W, _PILOT_F = columns("/vehicle", "wx_rad_s", 3), columns("/vehicle", "fx_m_s2", 3)
_WHEELS = columns("/wheels", "w1_rad_s", 3)
_ELAPSED = columns("/timing", "elapsed_s").start
_LATENESS = columns("/timing", "lateness_s", 2)  # and cost
_TIMING = columns("/timing", "lateness_s", 5)


class History:
    """The thinned ticks of the last SPAN seconds.

    A point is the last tick of its STEP, with the largest lateness and cost of all.
    """

    def __init__(self, head_S: Vec3) -> None:
        self._head_S = head_S
        self._points: deque[Array] = deque(maxlen=round(SPAN / STEP) + 1)
        self._angle = np.zeros(3)
        self._last: Array | None = None

    def add(self, rows: Sequence[Sequence[float]]) -> None:
        """Take the ticks since the last call, rows (n, LIVE_ROW) in order of time."""
        if not len(rows):
            return
        new = np.asarray(rows, dtype=np.float64).reshape(-1, LIVE_ROW)
        ticks = new if self._last is None else np.vstack([self._last, new])
        turned = wheel_angles(ticks[:, _TIME], ticks[:, _WHEELS])[-1]
        self._angle = (self._angle + turned) % (2.0 * np.pi)
        slots = np.floor(np.nan_to_num(new[:, _ELAPSED]) / STEP)
        for block in np.split(new, np.flatnonzero(np.diff(slots)) + 1):
            self._keep(block)
        self._last = new[-1]

    @property
    def empty(self) -> bool:
        """Whether there has been no tick yet."""
        return self._last is None

    @property
    def time(self) -> float:
        """Time of the last tick, s."""
        return 0.0 if self._last is None else float(self._last[_TIME])

    @property
    def timing(self) -> tuple[float, float, float, float, int]:
        """Timing of the last tick: lateness, cost, input age (s), missed deadlines, state."""
        lateness, cost, age, missed, state = (
            (0.0,) * 5 if self._last is None else self._last[_TIMING].tolist()
        )
        return lateness, cost, age, missed, int(state)

    def pose(self) -> Pose:
        """Return the pose of the last tick."""
        last = np.zeros(LIVE_ROW) if self._last is None else self._last
        felt = felt_columns(last[None], self._head_S)[0]
        return Pose(last[_Q], last[_P], self._angle, last[_PILOT_F], felt[1:4])

    def traces(self) -> Traces:
        """Return the last SPAN seconds over the loop's own time."""
        points = np.array(self._points).reshape(-1, LIVE_ROW)
        felt = felt_columns(points, self._head_S)
        force, rate = felt[:, 1:4], felt[:, 4:7]
        return Traces(
            time=points[:, _ELAPSED],
            pilot_f=points[:, _PILOT_F],
            felt_f=force,
            pilot_w=points[:, _PILOT_W],
            felt_w=rate,
            wheel_speed=points[:, _WHEELS],
            p_W=points[:, _P],
            timing=points[:, _LATENESS],
        )

    def _keep(self, block: Array) -> None:
        point = block[-1].copy()
        worst = block[:, _LATENESS].max(axis=0)
        if self._points and np.floor(self._points[-1][_ELAPSED] / STEP) == np.floor(
            point[_ELAPSED] / STEP
        ):
            worst = np.maximum(worst, self._points.pop()[_LATENESS])
        point[_LATENESS] = worst
        self._points.append(point)
