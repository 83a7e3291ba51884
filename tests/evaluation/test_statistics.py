"""Figures of columns in pieces, against numpy on the whole."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from atlas_cueing.evaluation.statistics import Magnitudes, Peaks, Spread, distance
from atlas_cueing.rotations import length

SINGLE = 1.2e-7  # twice what single precision rounds by

columns = arrays(np.float64, st.integers(1, 40), elements=st.floats(0.0, 1e6))
cuts = st.lists(st.integers(0, 40), max_size=5).map(sorted)


def spread(x: np.ndarray, cuts: list[int]) -> Spread:
    """Of x in pieces, some of them empty."""
    figures = Spread()
    for piece in np.split(x, cuts):
        figures.add(piece)
    return figures


@given(columns, cuts)
def test_against_numpy(x: np.ndarray, cuts: list[int]) -> None:
    figures = spread(x, cuts)
    assert figures.count == len(x)
    assert figures.rms == pytest.approx(np.sqrt(np.mean(x**2)), rel=1e-12, abs=1e-150)
    assert figures.largest == np.max(x)
    for share in (0.0, 0.3, 0.95, 1.0):
        assert figures.quantile(share) == pytest.approx(
            np.quantile(x, share), rel=SINGLE, abs=1e-38
        )
        assert figures.quantile(share) <= figures.largest


@given(columns, st.data())
def test_quantile_of_some(x: np.ndarray, data: st.DataObject) -> None:
    counted = np.array(data.draw(st.lists(st.booleans(), min_size=len(x), max_size=len(x))))
    expected = np.quantile(x[counted], 0.8) if counted.any() else 0.0
    assert spread(x, []).quantile(0.8, counted) == pytest.approx(expected, rel=SINGLE, abs=1e-38)


def test_a_quantile_leaves_the_values_where_they_are() -> None:
    """Two quantiles of one column, then those of a part of it, then more values."""
    x = np.random.default_rng(3).random(1000)
    figures = spread(x, [])
    counted = np.arange(1000) < 500
    for _ in range(2):
        assert figures.quantile(0.5) == pytest.approx(np.median(x), rel=SINGLE)
        assert figures.quantile(0.9) == pytest.approx(np.quantile(x, 0.9), rel=SINGLE)
        assert figures.quantile(0.5, counted) == pytest.approx(np.median(x[:500]), rel=SINGLE)
    figures.add(x + 1.0)
    assert figures.quantile(0.5) == pytest.approx(1.0, abs=0.01)


def test_places_among_more_values_than_single_precision_counts() -> None:
    """20 million different places; their values are 0 or 1."""
    figures = Spread()
    zeros, ones = 16_777_300, 3_000_000
    figures.add(np.zeros(zeros))
    figures.add(np.ones(ones))
    last_zero = (zeros - 1) / (zeros + ones - 1)
    assert figures.quantile(last_zero) == pytest.approx(0.0, abs=1e-6)
    assert figures.quantile(last_zero + 1.0 / (zeros + ones)) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_a_number_that_is_none_is_seen_in_every_figure(wrong: float) -> None:
    """Whatever piece it is in, and although a quantile need not be as large."""
    for place in (0, 10, 39):
        x = np.ones(40)
        x[place] = wrong
        figures = spread(x, [1, 20])
        np.testing.assert_equal([figures.rms, figures.largest], [wrong, wrong])
        np.testing.assert_equal(figures.quantile(0.5), wrong if np.isnan(wrong) else 1.0)


def test_what_is_too_large_for_single_precision() -> None:
    figures = spread(np.array([1.0, 1e199, 1e199]), [])
    assert figures.largest == 1e199
    assert figures.quantile(0.95) == 1e199


def test_nothing_is_zero() -> None:
    nothing = spread(np.empty(0), [])
    assert (
        nothing.rms
        == nothing.largest
        == nothing.quantile(0.5)
        == Magnitudes().rms
        == Peaks().largest
        == 0.0
    )


def test_spread_of_a_ramp() -> None:
    figures = spread(np.linspace(0.0, 1.0, 10_001), [5000]).figures("slope", "m")
    assert list(figures) == ["slope_rms_m", "slope_p95_m", "slope_max_m"]
    assert list(figures.values()) == pytest.approx([3.0**-0.5, 0.95, 1.0], rel=1e-4)


def test_peaks_are_largest_magnitudes_of_each_component() -> None:
    peaks = Peaks()
    for rows in ([[1.0, -2.0, 0.5]], [], [[-3.0, 1.0, 0.0], [2.0, 1.5, 0.25]]):
        peaks.add(np.array(rows).reshape(-1, 3))
    assert peaks.components.tolist() == [3.0, 2.0, 0.5]
    assert peaks.largest == 3.0
    peaks.add(np.array([[0.0, np.nan, 0.0]]))
    assert np.isnan(peaks.largest)


def test_length_of_rows() -> None:
    v = np.array([[3.0, 4.0, 12.0], [0.0, 0.0, -2.0]])
    assert length(v).tolist() == length(np.asfortranarray(v)).tolist() == [13.0, 2.0]
    assert distance(v + 1.0, np.ones((2, 3))).tolist() == [13.0, 2.0]


def test_the_peak_of_rest_has_no_sign() -> None:
    """Or it would be shown as -0 %."""
    peaks = Peaks()
    peaks.add(np.zeros((3, 3)))
    assert "-" not in repr(peaks.largest)
