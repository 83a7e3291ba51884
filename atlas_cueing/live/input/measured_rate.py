"""How many samples a second come, by their arrivals."""

from collections import deque

WINDOW = 2.0  # s of arrivals that are counted
_MOST = 4096  # arrivals; more than any allowed rate has in the window


class MeasuredRate:
    """Counts the arrivals of the last two seconds.

    The mean over the window and not the last interval: a simulator that stutters is as fast as it
    is on the whole.
    """

    def __init__(self) -> None:
        self._arrivals: deque[float] = deque(maxlen=_MOST)
        self._begun: float | None = None

    def add(self, arrival: float) -> None:
        """Count a sample that came at `arrival` (s), not before the last one."""
        self._begun = arrival if self._begun is None else self._begun
        self._arrivals.append(arrival)
        while self._arrivals[-1] - self._arrivals[0] > WINDOW:
            self._arrivals.popleft()

    def restart(self) -> None:
        """Begin to count anew, as after a gap that is no part of the rate."""
        self._arrivals.clear()
        self._begun = None

    @property
    def rate_hz(self) -> float | None:
        """Samples per second; None until they have come for as long as the window."""
        if self._begun is None or self._arrivals[-1] - self._begun < WINDOW:
            return None
        span = self._arrivals[-1] - self._arrivals[0]
        return (len(self._arrivals) - 1) / span if span > 0.0 else None
