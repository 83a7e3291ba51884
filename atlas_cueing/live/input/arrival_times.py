"""The times of samples: their arrival times without the jitter."""

# share of each error taken into the time of a sample: it settles over some five samples (assumed)
SETTLING = 0.2
# share taken into the period (T. Benedict & G. Bordner, IRE AC-7, 1962)
_DRIFT = SETTLING * SETTLING / (2.0 - SETTLING)
RANGE = 4.0  # the sender's true period lies within this factor of the nominal one (assumed)
# s; a sender whose own time is further from the arrivals, or leaps, is taken at its arrivals
LONGEST_SPAN = 1.0
_LEAST = 1e-6  # s from one sample to the next, when they are ahead of their arrivals


class ArrivalTimes:
    """Tracks a regular sender with an alpha-beta filter on arrival times.

    A sample's time is where the filter expects it, moved by a fifth of the error: a jitter of the
    network of s (rms) leaves some s / 3. Where samples carry their sender's time, the expectation
    is as far from the last one as that says. Without it whole periods without a sample are lost or
    unsent samples and no error; so after a pause of any length the filter is off by half a period
    at most.
    """

    def __init__(self, rate_hz: float) -> None:
        """Start without a sample; `rate_hz` is the nominal number of samples per second."""
        self._shortest, self._longest = 1.0 / (RANGE * rate_hz), RANGE / rate_hz
        self._period = 1.0 / rate_hz
        self._time: float | None = None
        self._sent: float | None = None

    @property
    def period(self) -> float:
        """Time from one sample to the next as measured up to now, s."""
        return self._period

    def expect(self, rate_hz: float) -> None:
        """From now on take `rate_hz` for the nominal number of samples per second."""
        self._shortest, self._longest = 1.0 / (RANGE * rate_hz), RANGE / rate_hz
        self._period = min(max(self._period, self._shortest), self._longest)

    def time(self, arrival: float, sent: float | None = None) -> float:
        """Return the time (s), later than all before, of the sample that came at `arrival` (s).

        sent: by the sender's own clock, s, where the sample carries it.
        """
        span = sent - self._sent if sent is not None and self._sent is not None else None
        self._sent = sent
        if self._time is None:
            self._time = arrival
            return arrival
        # of what is ahead of its arrival already, the next may come at any time
        least = self._time + (0.5 * self._shortest if self._time <= arrival else _LEAST)
        periods = max(1, round((arrival - self._time) / self._period))
        if span is None or not 0.0 < span < LONGEST_SPAN:
            expected = self._time + periods * self._period
        elif abs(arrival - self._time - span) < LONGEST_SPAN:
            expected = self._time + span
        else:
            expected = arrival
        error = arrival - expected
        self._time = max(expected + SETTLING * error, least)
        self._period = min(
            max(self._period + _DRIFT * error / periods, self._shortest), self._longest
        )
        return self._time
