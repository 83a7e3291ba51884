"""How punctual the loop was, in memory that does not grow."""

from array import array
from collections.abc import Sequence

# of a microsecond each; whatever is longer counts as 0.1 s, and the maximum is kept apart
_BINS = 100_000
_SHARES = {"p50": 0.5, "p99": 0.99, "p999": 0.999}


class Histogram:
    """Durations, by the microsecond."""

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
        """The duration (s) that `share` of all do not exceed, to a microsecond; 0 for none."""
        wanted, seen = share * self.count, 0
        for microseconds, count in enumerate(self._counts):
            seen += count
            if count and seen >= wanted:
                return min((microseconds + 1) * 1e-6, self.maximum)
        return 0.0

    def counts(self) -> Sequence[int]:
        """How many of each microsecond from 0 on."""
        return self._counts


class LoopTiming:
    """All figures of a run."""

    def __init__(self) -> None:
        self.lateness, self.cost = Histogram(), Histogram()
        self.missed = self.longest_row = self.collections = 0

    def to_json(self) -> dict[str, float]:
        """By name, with units; the object `timing` of the command's --json."""
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
