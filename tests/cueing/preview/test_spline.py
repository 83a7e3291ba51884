"""The spline against scipy's, and its bounds against the curve."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BSpline

from atlas_cueing.cueing.preview.spline import Spline, steps


def made(ticks: int = 101, dt: float = 0.01, rate_hz: float = 20.0) -> tuple[Spline, np.ndarray]:
    spline = Spline(ticks, dt, rate_hz)
    return spline, np.random.default_rng(ticks).normal(size=spline.points)


@pytest.mark.parametrize("ticks", [1, 2, 5, 6, 7, 101, 103])
@pytest.mark.parametrize("rate_hz", [3.0, 20.0, 1000.0])
def test_curve_and_derivatives_are_scipy_s(ticks: int, rate_hz: float) -> None:
    spline, points = made(ticks, rate_hz=rate_hz)
    knots = spline.interval * np.arange(-3, spline.points + 1)
    curve, time = BSpline(knots, points, 3), 0.01 * np.arange(ticks)
    time[-1] = min(time[-1], knots[-4])
    for order, matrix in enumerate((spline.value, spline.slope, spline.curvature)):
        expected = curve.derivative(order)(time) if order else curve(time)
        assert np.allclose(matrix @ points, expected, atol=1e-9 / spline.interval**order), order


@pytest.mark.parametrize(("ticks", "knots"), [(1, 1), (2, 1), (6, 1), (7, 2), (11, 2), (12, 3)])
def test_knots_are_whole_ticks_and_reach_over_the_flight(ticks: int, knots: int) -> None:
    spline = Spline(ticks, 0.01, 20.0)
    assert spline.interval == pytest.approx(0.05)
    assert spline.points == knots + 3
    assert spline.ends_between_ticks == ((ticks - 1) % 5 != 0 or ticks == 1)


def test_a_tick_that_is_longer_than_a_knot_is_one() -> None:
    assert Spline(11, 0.1, 20.0).interval == 0.1


@given(st.lists(st.floats(-10.0, 10.0), min_size=23, max_size=23))
def test_differences_of_control_points_bound_the_curve(values: list[float]) -> None:
    spline, points = Spline(101, 0.01, 20.0), np.array(values)
    matrices = (spline.value, spline.slope, spline.curvature)
    for order, matrix in enumerate(matrices):
        assert (
            np.max(np.abs(matrix @ points))
            <= np.max(np.abs(spline.difference(order) @ points)) * (1.0 + 1e-12) + 1e-12
        )
    jerk = np.diff(spline.curvature @ points) / 0.01
    assert (
        np.max(np.abs(jerk)) <= np.max(np.abs(spline.difference(3) @ points)) * (1.0 + 1e-9) + 1e-6
    )


def test_the_second_derivative_runs_straight_between_second_differences() -> None:
    spline, points = made()
    assert np.allclose(
        spline.straight() @ (spline.difference(2) @ points), spline.curvature @ points, atol=1e-9
    )


def test_steps() -> None:
    assert (steps(4) @ np.array([1.0, 3.0, 2.0, 2.5])).tolist() == [2.0, -1.0, 0.5]


def test_everything_is_sparse() -> None:
    """An hour costs sixty times what a minute costs."""
    short, long = Spline(7201, 1 / 120, 20.0), Spline(60 * 7200 + 1, 1 / 120, 20.0)
    for one, other in (
        (short.value, long.value),
        (short.slope, long.slope),
        (short.difference(3), long.difference(3)),
    ):
        assert other.nnz == pytest.approx(60 * one.nnz, rel=1e-2)
