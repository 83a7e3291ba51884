"""Figures of a column, against numpy on the whole."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from atlas_cueing.evaluation.statistics import by_rows, largest, length, mean, quantile, rms, spread

columns = arrays(np.float64, st.integers(1, 40), elements=st.floats(-1e6, 1e6))
EMPTY = np.empty(0)


@given(columns)
def test_against_numpy(x: np.ndarray) -> None:
    assert rms(x) == pytest.approx(np.sqrt(np.mean(x**2)), rel=1e-12, abs=1e-150)
    assert mean(x) == np.mean(x)
    assert quantile(x, 0.3) == np.quantile(x, 0.3)
    assert largest(x) == np.max(np.abs(x))


def test_nothing_is_zero() -> None:
    assert rms(EMPTY) == mean(EMPTY) == quantile(EMPTY, 0.5) == largest(EMPTY) == 0.0
    assert largest(np.empty((0, 3))) == 0.0


def test_spread_of_a_ramp() -> None:
    figures = spread("slope", "m", np.linspace(0.0, 1.0, 10_001))
    assert list(figures) == ["slope_rms_m", "slope_p95_m", "slope_max_m"]
    assert list(figures.values()) == pytest.approx([3.0**-0.5, 0.95, 1.0], rel=1e-4)


def test_length_of_rows() -> None:
    assert length(np.array([[3.0, 4.0, 12.0], [0.0, 0.0, -2.0]])).tolist() == [13.0, 2.0]


@pytest.mark.parametrize("count", [0, 1, (1 << 14) - 1, 1 << 14, (1 << 14) + 1, 40_000])
def test_by_rows_is_the_function_on_the_whole(count: int) -> None:
    p, q = np.random.default_rng(count).normal(size=(2, count, 3))
    seen: list[int] = []

    def difference(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        seen.append(len(a))
        return a - b

    np.testing.assert_array_equal(by_rows(difference, p, q), p - q)
    assert sum(seen) == count
    assert max(seen) <= 1 << 14
