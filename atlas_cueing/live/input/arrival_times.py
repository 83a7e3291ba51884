"""The times of samples that carry none: their arrival times without the jitter."""

# share of each error taken into the time of a sample: it settles over some five samples (assumed)
SETTLING = 0.2
# share taken into the period (T. Benedict & G. Bordner, IRE AC-7, 1962)
_DRIFT = SETTLING * SETTLING / (2.0 - SETTLING)
RANGE = 4.0  # the sender's true period lies within this factor of the nominal one (assumed)


class ArrivalTimes:
    """Tracks a regular sender with an alpha-beta filter on arrival times.

    A sample's time is where the filter expects it, moved by a fifth of the error: a jitter of the
    network of s (rms) leaves some s / 3. Whole periods without a sample are lost or unsent samples
    and no error; so after a pause of any length the filter is off by half a period at most.
    """

    def __init__(self, rate_hz: float) -> None:
        """Start without a sample; `rate_hz` is the nominal number of samples per second."""
        self._shortest, self._longest = 1.0 / (RANGE * rate_hz), RANGE / rate_hz
        self._period = 1.0 / rate_hz
        self._time: float | None = None

    @property
    def period(self) -> float:
        """Time from one sample to the next as measured up to now, s."""
        return self._period

    def time(self, arrival: float) -> float:
        """Return the time (s), later than all before, of the sample that came at `arrival` (s)."""
        if self._time is None:
            self._time = arrival
            return arrival
        periods = max(1, round((arrival - self._time) / self._period))
        expected = self._time + periods * self._period
        error = arrival - expected
        self._time = max(expected + SETTLING * error, self._time + 0.5 * self._shortest)
        self._period = min(
            max(self._period + _DRIFT * error / periods, self._shortest), self._longest
        )
        return self._time
