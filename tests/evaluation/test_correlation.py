"""Delays and gains that are known, and numpy's correlation at every shift."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.evaluation.correlation import MOST, WINDOW, Correlation

DT = 0.008
T = np.arange(5000) * DT


def correlation(
    reference: np.ndarray, delayed: np.ndarray, dt: float, smallest: float = 0.0
) -> tuple[float, float]:
    signals = Correlation(dt, smallest)
    signals.add(reference, delayed)
    return signals.peak()


def wave(t: np.ndarray) -> np.ndarray:
    """Smooth, of many frequencies that have no common period."""
    return np.sin(2.0 * t) + 0.7 * np.sin(0.9 * t + 1.0) + 0.4 * np.cos(3.3 * t)


@given(st.floats(-0.45, 0.45), st.floats(0.05, 5.0), st.floats(-20.0, 20.0))
def test_a_delay_is_found_to_a_tenth_of_a_millisecond(
    delay: float, gain: float, offset: float
) -> None:
    peak, found = correlation(wave(T), offset + gain * wave(T - delay), DT)
    assert found == pytest.approx(delay, abs=1e-4)
    assert peak == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("dt", [0.001, 0.02])
@pytest.mark.parametrize("delay", [-0.2, -0.0004, 0.0, 0.0123, 0.3])
@pytest.mark.parametrize("frequency", [0.5, 3.0])
def test_a_sine(frequency: float, delay: float, dt: float) -> None:
    t = np.arange(0.0, 30.0, dt)
    peak, found = correlation(np.sin(frequency * t), 0.6 * np.sin(frequency * (t - delay)), dt)
    assert found == pytest.approx(delay, abs=1e-4)
    assert peak == pytest.approx(1.0, abs=1e-4)


@given(st.floats(-0.45, 0.45))
def test_exchanging_the_signals_turns_the_delay_round(delay: float) -> None:
    p, q = wave(T), wave(T - delay) + 0.5 * np.sin(1.3 * T)
    forth, back = correlation(p, q, DT), correlation(q, p, DT)
    assert forth[0] == pytest.approx(back[0], abs=1e-12)
    assert forth[1] == pytest.approx(-back[1], abs=1e-9)


@pytest.mark.parametrize("count", [40, 500, 9000, 20_000])
def test_the_peak_is_pearsons_correlation_over_the_overlap(count: int) -> None:
    """Noise that is late by whole ticks, mixed with other noise.

    Every shift by numpy, one at a time; several blocks.
    """
    random = np.random.default_rng(count)
    late = 7
    p, other = random.normal(size=(2, count))
    q = 0.8 * np.roll(p, late) + 0.4 * other
    most = min(round(WINDOW / DT), count // 4)
    shifts = range(-most, most + 1)
    values = [
        np.corrcoef(p[max(-s, 0) : count - max(s, 0)], q[max(s, 0) : count + min(s, 0)])[0, 1]
        for s in shifts
    ]
    k = int(np.argmax(values))
    assert shifts[k] == late
    peak, delay = correlation(p, q, DT)
    a, b, c = values[k - 1 : k + 2]
    offset = 0.5 * (a - c) / (a - 2.0 * b + c)
    assert delay == pytest.approx((late + offset) * DT, abs=1e-10)
    assert peak == pytest.approx(min(b - 0.25 * (a - c) * offset, 1.0), abs=1e-10)


def in_pieces(
    reference: np.ndarray, delayed: np.ndarray, pieces: list[int], dt: float = DT
) -> tuple[float, float]:
    """Of signals that come in pieces that end there."""
    signals = Correlation(dt)
    for v, p in zip(np.split(reference, pieces), np.split(delayed, pieces), strict=True):
        signals.add(v, p)
    return signals.peak()


PIECES = [[7], [7168, 14_336], [1, 2, 3, 60, 61, 123, 200], [19_999], [8192, 8193, 16_384, 16_500]]


@pytest.mark.parametrize("pieces", PIECES, ids=str)
@pytest.mark.parametrize("late", [-40, 0, 11])
def test_in_pieces_it_is_pearsons_correlation_over_the_overlap_too(
    pieces: list[int], late: int
) -> None:
    """Noise around values far from zero that drift away, against numpy at the peak."""
    count = 20_000
    noise, other = np.random.default_rng(1).normal(size=(2, count))
    p = noise + np.linspace(1e3, 1e3 + 5.0, count)
    q = np.roll(noise, late) + 0.3 * other - 1e4
    if late >= 0:
        compared = p[: count - late], q[late:]
    else:
        compared = p[-late:], q[:late]
    peak, delay = in_pieces(p, q, pieces)
    assert delay == pytest.approx(late * DT, abs=0.5 * DT)
    # the parabola's vertex is a little higher
    assert peak == pytest.approx(np.corrcoef(*compared)[0, 1], abs=2e-3)
    assert (peak, delay) == pytest.approx(correlation(p, q, DT), abs=1e-10)


@pytest.mark.parametrize("pieces", PIECES, ids=str)
@pytest.mark.parametrize("gain", [0.1, -1.0 / 3.0, 7.3])
def test_a_long_ramp_in_pieces_is_not_late(pieces: list[int], gain: float) -> None:
    """The first piece says little about the mean: rounding must not choose a shift."""
    t = np.arange(20_000) * DT
    peak, delay = in_pieces(t, gain * t + 1e3, pieces)
    assert peak == pytest.approx(np.sign(gain))
    assert delay == 0.0


def test_a_first_piece_that_stands_still() -> None:
    """At rest for a thousandth of the record, far below what follows."""
    moving = 1e3 + wave(np.arange(50_000) * DT)
    p, q = (np.concatenate([np.zeros(50), x]) for x in (moving, np.roll(moving, 5)))
    assert in_pieces(p, q, [50]) == pytest.approx(correlation(p, q, DT), abs=1e-10)


def test_the_window_of_a_log_that_claims_any_rate_is_bounded() -> None:
    noise = np.random.default_rng(3).normal(size=5 * MOST)
    late = 1000
    peak, delay = correlation(noise, np.roll(noise, late), 1e-12)
    assert (peak, delay / 1e-12) == (pytest.approx(1.0, abs=0.02), pytest.approx(late, abs=0.5))
    assert correlation(noise, np.roll(noise, MOST + 1000), 1e-12)[0] < 0.1


@pytest.mark.parametrize("rounding", [-1e-15, 0.0, 1e-15])
def test_rounding_of_the_step_does_not_move_the_window(rounding: float) -> None:
    """At 125 Hz it ends amid two ticks."""
    p, q = np.sin(T), np.sin(T - 0.7)
    assert correlation(p, q, 0.008 * (1.0 + rounding))[1] == pytest.approx(62 * 0.008, rel=1e-12)


def test_a_part_that_is_not_alike_lowers_the_correlation() -> None:
    t = np.arange(10_000) * 2.0 * np.pi / 1000.0
    peak, delay = correlation(np.sin(t), 3.0 * np.sin(t) + 4.0 * np.sin(7.0 * t), 0.01)
    assert peak == pytest.approx(0.6, abs=0.02)
    assert delay == pytest.approx(0.0, abs=0.01)


def test_the_opposite_is_negative() -> None:
    """A slow sine: half a period is far outside the window."""
    t = np.arange(20_000) * DT
    peak, _ = correlation(np.sin(0.2 * t), -np.sin(0.2 * t), DT)
    assert -1.0 <= peak < -0.95


@pytest.mark.parametrize("late", [False, True])
def test_a_delay_beyond_the_window_is_the_windows_end(late: bool) -> None:
    p, q = np.sin(T), np.sin(T - 0.7)
    peak, delay = correlation(*((p, q) if late else (q, p)), DT)
    assert delay == pytest.approx(WINDOW if late else -WINDOW, abs=DT)
    assert peak == pytest.approx(np.cos(0.2), abs=0.05)


@pytest.mark.parametrize("count", [40, 100, 300, 1000, 5000])
@pytest.mark.parametrize("gain", [0.1, 1.0 / 3.0, 1.0, 7.3])
def test_what_fits_at_any_shift_is_not_late(gain: float, count: int) -> None:
    peak, delay = correlation(T[:count], gain * T[:count] + 1.0, DT)
    assert peak == pytest.approx(1.0)
    assert delay == 0.0


def test_rounding_does_not_make_a_correlation_larger_than_one() -> None:
    for seed in range(50):
        noise = np.random.default_rng(seed).normal(size=100)
        for sign in (1.0, -1.0):
            assert abs(correlation(noise, sign * noise, DT)[0]) <= 1.0


def test_at_least_three_quarters_of_a_short_record_are_compared() -> None:
    p = np.random.default_rng(8).normal(size=140)
    assert correlation(p[40:], p[:100], DT)[1] != pytest.approx(40 * DT, abs=2 * DT)
    assert correlation(p[24:124], p[:100], DT)[1] == pytest.approx(24 * DT, abs=DT)


@pytest.mark.parametrize("constant", [0.0, -9.80665, 0.1, 1e9])
@pytest.mark.parametrize("count", [0, 1, 2, 3, 100, 5000])
def test_what_does_not_vary_has_no_correlation(constant: float, count: int) -> None:
    still, moving = np.full(count, constant), wave(T[:count])
    assert (
        correlation(still, moving, DT)
        == correlation(moving, still, DT)
        == correlation(still, still, DT)
        == (0.0, 0.0)
    )


@pytest.mark.parametrize("smallest", [0.1, 10.0])
def test_what_varies_too_little_has_no_correlation(smallest: float) -> None:
    deviation = np.std(wave(T))
    assert correlation(wave(T), wave(T), DT, 1.001 * deviation) == (0.0, 0.0)
    assert correlation(wave(T), smallest * wave(T), DT, 0.999 * deviation * min(smallest, 1.0))[
        0
    ] == pytest.approx(1.0)


def test_a_single_step_at_the_end() -> None:
    """At most shifts nothing that varies is left in the overlap."""
    step = np.zeros(1000)
    step[-1] = 1.0
    assert correlation(step, step, DT) == (pytest.approx(1.0), 0.0)


@pytest.mark.parametrize("count", [2, 3, 4, 5, 8])
def test_very_short_signals(count: int) -> None:
    peak, delay = correlation(wave(T[:count]), wave(T[:count]), DT)
    assert peak == pytest.approx(1.0)
    assert delay == pytest.approx(0.0, abs=DT)


@pytest.mark.parametrize("dt", [0.0, -0.01, np.nan, np.inf])
def test_a_step_that_is_none(dt: float) -> None:
    wave = np.sin(np.arange(50.0))
    assert correlation(wave, wave, dt) == (0.0, 0.0)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, 1e200])
def test_numbers_that_are_none(wrong: float) -> None:
    wave = np.sin(np.arange(50.0))
    spoilt = wave.copy()
    spoilt[20] = wrong
    with np.errstate(all="ignore"):
        assert correlation(wave, spoilt, 0.01) == (0.0, 0.0)
