"""Times of samples out of jittering arrivals."""

from random import Random

import numpy as np
import pytest

from atlas_cueing.live.input.arrival_times import RANGE, ArrivalTimes


@pytest.mark.parametrize("rate_hz", [30.0, 60.0, 120.0])
def test_jitter_is_cut_to_a_third(rate_hz: float) -> None:
    random, arrivals = Random(3), ArrivalTimes(rate_hz)
    sent = [k / rate_hz for k in range(600)]
    noise = [random.gauss(0.0, 0.05 / rate_hz) for _ in sent]
    error = np.array([arrivals.time(t + e) - t for t, e in zip(sent, noise, strict=True)])[100:]
    assert np.std(error) < 0.4 * np.std(noise)
    assert abs(np.mean(error)) < 0.3 * np.std(noise)


@pytest.mark.parametrize("off", [0.5, 0.9, 0.999, 1.001, 1.1, 2.0, 3.9])
def test_another_rate_than_the_nominal_is_found(off: float) -> None:
    """A sender of another rate than the nominal.

    For a slower one it may be a whole fraction: each sample is a few periods then.
    """
    arrivals = ArrivalTimes(100.0)
    period = 0.01 * off
    times = [arrivals.time(k * period) for k in range(400)]
    assert np.diff(times)[-50:] == pytest.approx(period, rel=1e-3)
    assert times[-1] == pytest.approx(399 * period, abs=0.02 * period)


def test_lost_samples_are_no_error() -> None:
    arrivals = ArrivalTimes(50.0)
    for k in range(100):
        if k % 7 not in (3, 4):
            assert arrivals.time(0.02 * k) == pytest.approx(0.02 * k, abs=1e-9)
    assert arrivals.period == pytest.approx(0.02)


def test_after_a_pause_it_finds_back() -> None:
    arrivals = ArrivalTimes(50.0)
    for k in range(50):
        arrivals.time(0.02 * k)
    times = [arrivals.time(100.009 + 0.02 * k) for k in range(60)]
    assert abs(times[0] - 100.009) <= 0.01
    assert times[-1] == pytest.approx(100.009 + 59 * 0.02, abs=2e-4)


def test_time_goes_on_and_the_period_stays_in_range_whatever_arrives() -> None:
    """A flood at one instant, or nonsense."""
    random, arrivals = Random(5), ArrivalTimes(120.0)
    arrival, last = 0.0, -1.0
    for _ in range(3000):
        arrival += random.choice([0.0, 0.0, 0.0, 1e-6, 0.01, 3.0])
        time = arrivals.time(arrival)
        assert time > last
        assert 1.0 / (120.0 * RANGE) <= arrivals.period <= RANGE / 120.0
        last = time
