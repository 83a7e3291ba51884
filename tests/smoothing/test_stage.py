"""The stage inside its rails: at the ticks and between them, whatever it is asked.

And on the cue when that is feasible.
"""

from collections.abc import Iterable
from itertools import pairwise
from math import inf, nan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.signals import Cue, StageLimits
from atlas_cueing.smoothing import StageSmoothing, Stop
from atlas_cueing.smoothing.axis import Step
from atlas_cueing.smoothing.stage import RailAxis

from .between import Between
from .cues import sines

TRAVEL, SPEED, ACCELERATION, JERK = 1.0, 1.5, 6.0, 60.0
LIMITS = [
    (1.0, 1.5, 6.0, 60.0),
    (0.1, 0.5, 4.0, 20.0),
    (0.05, 2.0, 20.0, 90.0),
    (5.0, 0.3, 2.0, 8.0),
]
DTS = [1.0 / 1000.0, 1.0 / 120.0, 1.0 / 20.0]
# Where a few ticks of full acceleration fit into the travel; 0.05 m is too little for a tick of 50
# ms at 20 m/s^2.
ROOMY = [(dt, limit) for dt in DTS for limit in LIMITS[:3] if limit[0] > 4.0 * limit[2] * dt * dt]

anything = st.floats() | st.sampled_from([nan, inf, -inf, 1e300, -1e308, 5e-324])
cues = st.tuples(anything, anything, anything)


def fly(dt: float, limit: tuple[float, ...], asked: Iterable[tuple[float, ...]]) -> float:
    """Ask for each cue for a tick; check every limit along the way.

    The largest share of the travel used.
    """
    axis, paths = RailAxis(dt, *limit), []
    between = Between(axis._axis)
    for cue in asked:
        p, v, a = axis.p, axis.v, axis.a
        axis.step(*cue)
        path = between.path(v, a, Step(axis.p - p, axis.v, axis.a, False))
        paths.append(path + np.array([p, 0.0, 0.0]))
        assert paths[-1][-1].tolist() == pytest.approx([axis.p, axis.v, axis.a], rel=1e-9, abs=1e-9)
    path = np.stack(paths)
    assert np.all(np.isfinite(path))
    used = np.max(np.abs(path), axis=(0, 1)) / limit[:3]
    assert np.all(used <= 1.0 + 1e-9), used
    assert np.max(np.abs(np.diff(path[:, :, 2]))) <= limit[3] * dt / 10.0 * (1.0 + 1e-6)
    return float(used[0])


@pytest.mark.parametrize("dt", DTS)
@pytest.mark.parametrize("limit", LIMITS)
def test_limits_hold_between_ticks_for_random_cues(
    dt: float, limit: tuple[float, float, float, float]
) -> None:
    """Held cues, long enough to get somewhere, and noise."""
    random = np.random.default_rng(3)
    asked: list[tuple[float, ...]] = []
    while len(asked) < 1500:
        size, ticks = 10.0 ** random.uniform(-1.0, 2.0), int(random.uniform(0.0, 0.5) / dt) + 1
        cue, noise = (
            random.standard_normal(3),
            random.standard_normal((ticks, 3)) * (random.random() < 0.5),
        )
        asked += [tuple(x) for x in size * (cue + noise) * limit[:3]]
    assert fly(dt, limit, asked) > 0.01


@given(st.sampled_from(DTS), st.sampled_from(LIMITS), st.lists(cues, min_size=1, max_size=40))
def test_limits_hold_for_any_cues(
    dt: float, limit: tuple[float, ...], asked: list[tuple[float, float, float]]
) -> None:
    fly(dt, limit, asked)


@pytest.mark.parametrize(("dt", "limit"), ROOMY)
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_driven_at_the_rail_it_uses_the_travel_and_no_more(
    dt: float, limit: tuple[float, ...], side: float
) -> None:
    """Running at the end of the travel with the full speed, on a cue that goes on outside."""
    ticks = int((limit[0] / limit[1] + limit[1] / limit[2] + 0.7) / dt)
    used = fly(dt, limit, ((side * limit[1] * n * dt, side * limit[1], 0.0) for n in range(ticks)))
    assert used > (0.9 if dt < 0.01 else 0.8), used


@pytest.mark.parametrize(("dt", "limit"), ROOMY)
@pytest.mark.parametrize("far", [1.5, 9.0])
def test_a_cue_far_beyond_the_rail_ends_at_the_rail(
    dt: float, limit: tuple[float, ...], far: float
) -> None:
    """The speed asked for on the way is clipped before the room is looked at.

    Otherwise the stage would stop short of it, or creep.
    """
    ticks = int((2.0 * limit[0] / limit[1] + 3.0 * limit[1] / limit[2] + 2.0) / dt)
    used = fly(dt, limit, ((far * limit[0], 0.0, 0.0) for _ in range(ticks)))
    assert used > (0.9 if dt < 0.01 else 0.8), used


@pytest.mark.parametrize("dt", DTS)
def test_every_state_has_a_certified_successor(dt: float) -> None:
    """From any state of random cues the stop alone stays inside, to standstill."""
    random = np.random.default_rng(8)
    axis = RailAxis(dt, 0.3, SPEED, ACCELERATION, JERK)
    for _ in range(600):
        axis.step(*(random.standard_normal(3) * (1.0, 3.0, 10.0)))
        low, high = Stop.plan(axis.v, axis.a, ACCELERATION, JERK).span()
        assert axis.p + low >= -0.3
        assert axis.p + high <= 0.3


@pytest.mark.parametrize("dt", DTS)
def test_a_bad_cue_stops_it_smoothly_where_it_is(dt: float) -> None:
    axis, v = RailAxis(dt, TRAVEL, SPEED, ACCELERATION, JERK), 0.8
    t = 0.0
    while axis.v < 0.7:
        axis.step(v * t, v, 0.0)
        t += dt
    stop = Stop.plan(axis.v, axis.a, ACCELERATION, JERK)
    expected = axis.p + stop.at(stop.duration)[0]
    states = [(axis.v, axis.a)]
    for bad in (nan, inf, -inf) * (int(2.0 / dt) // 3 + 1):
        assert not axis.step(bad, v, 0.0)
        states.append((axis.v, axis.a))
    assert max(abs(a1 - a0) for (_, a0), (_, a1) in pairwise(states)) <= JERK * dt * (1.0 + 1e-6)
    assert axis.v == pytest.approx(0.0, abs=1e-12)
    assert axis.p == pytest.approx(expected, abs=2.0 * dt)  # braked at once, not some time later


@pytest.mark.parametrize("dt", DTS)
def test_a_feasible_cue_is_met(dt: float) -> None:
    """A sine that is already under way at its largest speed.

    Caught up with first, met ever after.
    """
    t = np.arange(0.0, 6.0, dt)
    p, v, a = (x[:, 0] for x in sines(t, np.array([[0.3]]), np.array([[2.0]]), np.array([[0.0]])))
    axis = RailAxis(dt, TRAVEL, SPEED, ACCELERATION, JERK)
    met = np.array([axis.step(*cue) for cue in zip(p, v, a, strict=True)])
    assert not met[1]
    assert np.all(met[t > 4.0])
    assert (axis.p, axis.v) == (pytest.approx(p[-1], abs=1e-5), pytest.approx(v[-1], abs=1e-4))


@pytest.mark.parametrize("to", [1e-3, 0.1, 0.9])
@pytest.mark.parametrize("dt", DTS)
def test_a_jump_is_caught_up_without_overshoot(to: float, dt: float) -> None:
    axis, reached, met = RailAxis(dt, TRAVEL, SPEED, ACCELERATION, JERK), [], False
    for _ in range(int(8.0 / dt)):
        met = axis.step(to, 0.0, 0.0)
        reached.append(axis.p)
    assert met
    assert axis.p == pytest.approx(to, abs=1e-9)
    assert max(reached) <= to * 1.01 + 1e-9


def test_a_cue_beyond_the_travel_is_not_met_and_one_inside_is() -> None:
    axis = RailAxis(1.0 / 120.0, TRAVEL, SPEED, ACCELERATION, JERK)
    assert axis.step(0.0, 0.0, 0.0)
    assert sum(axis.step(1.2, 0.0, 0.0) for _ in range(600)) == 0
    assert sum(axis.step(0.5, 0.0, 0.0) for _ in range(1200)) > 500


def test_no_room_between_ticks_is_refused() -> None:
    with pytest.raises(ValueError, match="travel"):
        RailAxis(1.0 / 20.0, 0.9 * 6.0 / 8.0 / 400.0, SPEED, ACCELERATION, JERK)
    RailAxis(1.0 / 20.0, 1.1 * 6.0 / 8.0 / 400.0, SPEED, ACCELERATION, JERK)


def test_each_axis_follows_its_own_cue_inside_its_own_limits() -> None:
    limits = StageLimits((1.0, 0.5, 0.25), (1.5, 1.0, 0.5), (6.0, 5.0, 4.0), (60.0, 50.0, 40.0))
    smoothing = StageSmoothing(1.0 / 120.0, limits)
    assert smoothing.p_WS_W == smoothing.v_WS_W == smoothing.a_WS_W == ZERO
    for _ in range(1200):
        met = smoothing.step(Cue(0.0, IDENTITY, ZERO, (0.9, -0.1, 0.26), ZERO, ZERO))
        assert np.all(np.abs(smoothing.v_WS_W) <= limits.speed)
        assert np.all(np.abs(smoothing.a_WS_W) <= limits.acceleration)
    assert not met  # z cannot
    assert smoothing.p_WS_W == pytest.approx((0.9, -0.1, 0.25), abs=1e-2)
    assert smoothing.v_WS_W == pytest.approx(ZERO, abs=1e-3)
    assert smoothing.a_WS_W == pytest.approx(ZERO, abs=1e-2)
