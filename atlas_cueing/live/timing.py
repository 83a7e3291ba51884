"""The punctuality of the loop, in memory that does not grow."""

# mypyc: runs every tick

from array import array
from collections.abc import Sequence
from math import degrees
from typing import Protocol

from ..rotation import Vec3

# of a microsecond each; what is longer counts as 0.1 s, and the maximum is kept apart
_BINS = 100_000
_SHARES = {"p50": 0.5, "p99": 0.99, "p999": 0.999}


class Histogram:
    """A histogram of durations, with bins of a microsecond."""

    def __init__(self) -> None:
        self._counts = array("Q", bytes(8 * (_BINS + 1)))
        self.count, self.maximum = 0, 0.0

    def add(self, duration: float) -> None:
        """Count one duration (s)."""
        self._counts[min(max(int(duration * 1e6), 0), _BINS)] += 1
        self.count += 1
        if duration > self.maximum:
            self.maximum = duration

    def percentile(self, share: float) -> float:
        """Return the duration (s) that `share` of all do not exceed, to a microsecond.

        It is 0 when there are none.
        """
        wanted, seen = share * self.count, 0
        for microseconds, count in enumerate(self._counts):
            seen += count
            if count and seen >= wanted:
                return min((microseconds + 1) * 1e-6, self.maximum)
        return 0.0

    def counts(self) -> Sequence[int]:
        """Return the number of durations in each bin, from 0 microseconds on."""
        return self._counts


class Placed(Protocol):
    """A command's places."""

    @property
    def wheel_angle(self) -> Vec3:
        """Angle of each wheel, rad."""

    @property
    def p_WS_W(self) -> Vec3:
        """Position of the stage, m."""


class LoopTiming:
    """All figures of the timing of a run.

    lateness: from a tick's deadline to its beginning.
    cost: from a tick's beginning until its set point has been sent.
    missed: slots that began only when the next one should have.
    longest_row: most of them one after the other.
    collections: garbage collections while the loop ran.
    wheel_difference, stage_difference: largest difference between a commanded wheel angle (rad) or
        position of the stage (m) and the last that was sent.
    """

    def __init__(self) -> None:
        self.lateness = Histogram()
        self.cost = Histogram()
        self.missed = 0
        self.longest_row = 0
        self.collections = 0
        self.wheel_difference = self.stage_difference = 0.0

    def add_difference(self, commanded: "Placed", sent: "Placed") -> None:
        """Count a command that was not sent, and the last one that was."""
        wheels = _difference(commanded.wheel_angle, sent.wheel_angle)
        self.wheel_difference = max(self.wheel_difference, wheels)
        stage = _difference(commanded.p_WS_W, sent.p_WS_W)
        self.stage_difference = max(self.stage_difference, stage)

    def to_json(self) -> dict[str, float]:
        """Return the figures by name, the unit in the name: `timing` of the command's --json."""
        figures: dict[str, float] = {"ticks": self.lateness.count, "missed_deadlines": self.missed}
        figures["most_missed_in_a_row"] = self.longest_row
        figures["garbage_collections"] = self.collections
        figures["wheel_difference_deg"] = degrees(self.wheel_difference)
        figures["stage_difference_mm"] = 1e3 * self.stage_difference
        for name, histogram in (("lateness", self.lateness), ("tick_cost", self.cost)):
            figures |= {
                f"{name}_{label}_us": round(1e6 * histogram.percentile(share))
                for label, share in _SHARES.items()
            }
            figures[f"{name}_max_us"] = round(1e6 * histogram.maximum, 1)
        return figures


def _difference(one: Vec3, other: Vec3) -> float:
    return max(abs(a - b) for a, b in zip(one, other, strict=True))
