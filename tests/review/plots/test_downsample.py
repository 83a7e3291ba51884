"""Fewer points, every peak."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.review.plots.downsample import POINTS, thinned


def test_few_rows_are_all_kept() -> None:
    assert np.array_equal(thinned(np.zeros((POINTS, 2))), np.arange(POINTS))
    assert len(thinned(np.empty((0, 3)))) == 0


@given(st.integers(0, 10_000), st.integers(1, 3), st.integers(50, 400))
def test_every_peak_is_kept(seed: int, columns: int, points: int) -> None:
    """Highest and lowest of each column survive, overall and in any long stretch."""
    values = np.random.default_rng(seed).normal(size=(3000, columns))
    kept = thinned(values, points)
    assert len(kept) <= points
    assert (kept[0], kept[-1]) == (0, 2999)
    assert np.all(np.diff(kept) > 0)
    wide = 2 * -(-3000 // ((points - 2) // (2 * columns)))
    for start in range(0, 3000 - wide, wide):
        stretch = (kept >= start) & (kept < start + wide)
        assert stretch.any()
    assert np.array_equal(values[kept].max(axis=0), values.max(axis=0))
    assert np.array_equal(values[kept].min(axis=0), values.min(axis=0))


def test_a_spike_of_one_tick_is_seen() -> None:
    values = np.zeros((600_000, 2))
    values[123_456, 1] = 1.0
    assert 123_456 in thinned(values)


def test_a_gap_stays_a_gap() -> None:
    values = np.sin(np.arange(100_000.0))[:, None]
    values[50_000] = np.nan
    assert np.isnan(values[thinned(values)]).sum() == 1


@pytest.mark.parametrize("n", [POINTS + 1, 2 * POINTS - 1, 9999, 10_007])
def test_odd_lengths(n: int) -> None:
    kept = thinned(np.arange(float(n))[:, None])
    assert kept[-1] == n - 1
    assert len(kept) <= POINTS
