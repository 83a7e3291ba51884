"""The stage's plan: limits, rest, and that no other motion is better."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from atlas_cueing.cueing.preview.spline import Spline
from atlas_cueing.cueing.preview.stage_plan import plan_stage
from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.rotations import Array
from atlas_cueing.signals import Cue
from atlas_cueing.smoothing.stage import StageSmoothing

from .flights import DT, LIMITS

TIME = np.arange(501) * DT


def planned(d_W: Array) -> tuple[Array, Array, Array, Array]:
    spline = Spline(len(d_W), DT, 10.0)
    points = plan_stage(spline, d_W, LIMITS)
    return (
        spline.value @ points,
        spline.slope @ points,
        spline.curvature @ points,
        spline.difference(3) @ points,
    )


def demand(x: Array) -> Array:
    return np.stack([x, np.zeros_like(x), -x], axis=1)


def check(p: Array, v: Array, a: Array, jerk: Array) -> None:
    limits = (LIMITS.travel, LIMITS.speed, LIMITS.acceleration, LIMITS.jerk)
    for values, limit in zip((p, v, a, jerk), limits, strict=True):
        assert np.all(np.abs(values) <= np.array(limit))
    for values in (p[0], v[0], a[0], v[-1], a[-1]):
        assert np.allclose(values, 0.0, atol=1e-6)


def test_a_demand_that_fits_is_given() -> None:
    """A push and its brake, from rest to rest: never more than a hundredth of it is lacking."""
    bump = 0.2 * np.sin(np.pi * TIME / TIME[-1]) ** 4
    d = np.gradient(np.gradient(bump, DT), DT)
    p, v, a, jerk = planned(demand(d))
    check(p, v, a, jerk)
    assert np.max(np.abs(a[:, 0] - d)) < 0.01 * np.max(np.abs(d))
    assert np.allclose(p[:, 0], bump, atol=2e-3)
    assert np.allclose(p[:, 1], 0.0, atol=1e-6)
    assert np.allclose(p[:, 2], -p[:, 0], atol=2e-3)


def test_a_lasting_demand_is_given_for_nothing() -> None:
    """From rest to rest there is no lasting acceleration.

    The stage is no better than standing still, and no worse.
    """
    d = np.full_like(TIME, 0.7)
    _, _, a, _ = planned(demand(d))
    assert np.mean((a[:, 0] - d) ** 2) <= np.mean(d**2) + 1e-9


@given(seed=st.integers(0, 1000), size=st.sampled_from([0.1, 2.0, 50.0, 1e4]))
@settings(max_examples=10)
def test_limits_hold_for_any_demand(seed: int, size: float) -> None:
    random = np.random.default_rng(seed)
    slow = np.repeat(random.normal(size=51), 10)[:501] * size
    p, v, a, jerk = planned(demand(slow))
    check(p, v, a, jerk)
    # never worse than standing still
    assert np.mean((a[:, 0] - slow) ** 2) <= np.mean(slow**2) + 1e-6 * size**2


@pytest.mark.parametrize("ticks", [1, 2, 3, 6, 11, 13])
def test_short_flights(ticks: int) -> None:
    p, v, a, jerk = planned(demand(np.ones(ticks)))
    check(p, v, a, jerk)


def test_without_limits_it_is_the_least_squares_answer() -> None:
    """Against scipy's dense least squares over the same splines."""
    d = np.sin(2.0 * TIME[:101]) + 0.3
    wide = type(LIMITS)(*[(1e3, 1e3, 1e3)] * 4)
    spline = Spline(101, DT, 10.0)
    points = plan_stage(spline, demand(d), wide)[:, 0]
    free = np.zeros((spline.points, spline.points - 5))
    free[3:-2] = np.eye(spline.points - 5)
    free[-2:, -1] = 1.0  # the last three are one, the first three zero
    answer = lsq_linear(spline.curvature.toarray() @ free, d).x
    assert np.allclose(spline.curvature @ points, spline.curvature @ (free @ answer), atol=1e-5)


def test_smoothing_can_follow_right_up_to_the_ends_of_the_travel() -> None:
    """A demand that throws the stage from end to end passes the certified smoothing unchanged."""
    spline = Spline(len(TIME), DT, 20.0)
    points = plan_stage(spline, demand(30.0 * np.sin(2.5 * TIME)), LIMITS)
    p, v, a = spline.value @ points, spline.slope @ points, spline.curvature @ points
    assert np.max(np.abs(p[:, 0])) > 0.8 * LIMITS.travel[0]
    smoothing = StageSmoothing(DT, LIMITS)
    for row in zip(p.tolist(), v.tolist(), a.tolist(), strict=True):
        smoothing.step(Cue(0.0, IDENTITY, ZERO, *map(tuple, row)))
        assert np.allclose(smoothing.p_WS_W, row[0], atol=1e-4)
