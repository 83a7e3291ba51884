"""The punctuality of the loop, in memory that does not grow."""

from array import array
from collections.abc import Sequence

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


class LoopTiming:
    """All figures of the timing of a run.

    lateness: from a tick's deadline to its beginning.
    cost: from a tick's beginning until its set point has been sent.
    missed: deadlines that were left out.
    longest_row: most deadlines missed one after the other.
    collections: garbage collections while the loop ran.
    """

    def __init__(self) -> None:
        self.lateness = Histogram()
        self.cost = Histogram()
        self.missed = 0
        self.longest_row = 0
        self.collections = 0

    def to_json(self) -> dict[str, float]:
        """Return the figures by name, the unit in the name: `timing` of the command's --json."""
        figures: dict[str, float] = {"ticks": self.lateness.count, "missed_deadlines": self.missed}
        figures["most_missed_in_a_row"] = self.longest_row
        figures["garbage_collections"] = self.collections
        for name, histogram in (("lateness", self.lateness), ("tick_cost", self.cost)):
            figures |= {
                f"{name}_{label}_us": round(1e6 * histogram.percentile(share))
                for label, share in _SHARES.items()
            }
            figures[f"{name}_max_us"] = round(1e6 * histogram.maximum, 1)
        return figures
