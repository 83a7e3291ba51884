"""One axis: ruckig's traps, targets within reach met exactly, limits always kept."""

import re
from collections.abc import Callable
from math import inf, nan
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ruckig import Result, RuckigError

import atlas_cueing
from atlas_cueing.errors import PlanningError
from atlas_cueing.smoothing import axis as axis_module
from atlas_cueing.smoothing.axis import AxisSmoothing, Step

from .between import Between

DT, SPEED, ACCELERATION, JERK = 1.0 / 120.0, 31.0, 60.0, 600.0
FAR = (SPEED, 0.0)  # a target that no tick reaches, so that ruckig plans


def make(dt: float = DT) -> AxisSmoothing:
    return AxisSmoothing(dt, SPEED, ACCELERATION, JERK)


anything = st.floats(allow_nan=False) | st.sampled_from([inf, -inf, 1e300, -1e308, 5e-324])
dts = st.sampled_from([1.0 / 1000.0, 1.0 / 120.0, 1.0 / 20.0])


@pytest.mark.parametrize("bad", [0.0, -1.0, nan, inf])
@pytest.mark.parametrize("which", range(4))
def test_limits_that_are_none_are_refused(which: int, bad: float) -> None:
    numbers = [DT, SPEED, ACCELERATION, JERK]
    numbers[which] = bad
    with pytest.raises(ValueError, match=re.escape(str(bad))):
        AxisSmoothing(*numbers)


def test_a_tick_too_long_for_the_jerk_is_refused() -> None:
    """Where the speed could bend by more than all of its limit between two ticks."""
    with pytest.raises(ValueError, match="speed"):
        AxisSmoothing(1.0, 1.0, 100.0, 8.0)
    AxisSmoothing(1.0, 1.01, 100.0, 8.0)


@pytest.mark.parametrize("bad", [nan, inf, -inf])
@pytest.mark.parametrize("which", [0, 1])
def test_a_state_that_is_no_number_never_reaches_ruckig(which: int, bad: float) -> None:
    state = [0.0, 0.0]
    state[which] = bad
    with pytest.raises(PlanningError, match="finite"):
        make().towards(*state, *FAR)


@pytest.mark.parametrize("target", [(nan, 0.0), (0.0, nan), (nan, nan), (SPEED, nan), (nan, inf)])
def test_a_target_that_is_no_number_never_reaches_ruckig(target: tuple[float, float]) -> None:
    with pytest.raises(PlanningError, match="finite"):
        make().towards(1.0, 0.5, *target)


@given(anything, anything)
def test_clip_gives_the_nearest_target_from_which_the_speed_can_be_kept(v: float, a: float) -> None:
    axis = make()
    v1, a1 = axis.clip(v, a)
    assert abs(v1) + a1**2 / (2.0 * axis.jerk) <= axis.speed * (1.0 + 1e-12)
    assert abs(a1) <= axis.acceleration
    assert axis.clip(v1, a1) == (v1, a1)
    if abs(v) <= axis.speed:
        assert v1 == v
    if abs(a) <= axis.acceleration and abs(v1) + a**2 / (2.0 * axis.jerk) <= axis.speed * (
        1.0 - 1e-9
    ):
        assert a1 == a


@given(dts, st.floats(-0.9, 0.9), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_a_target_within_reach_is_met_exactly_at_the_tick(
    dt: float, k: float, share: float, j1: float, j2: float
) -> None:
    """Reached by two halves of jerk j1, j2 inside the limits.

    Met, and the displacement is theirs.
    """
    axis, h = make(dt), 0.5 * dt
    v, a = k * SPEED, share * (1.0 - abs(k)) * ACCELERATION
    p1, v1, a1 = 0.0, v, a
    for j in (j1 * axis.jerk * (1.0 - 1e-6), j2 * axis.jerk * (1.0 - 1e-6)):
        p1, v1, a1 = (
            p1 + v1 * h + a1 * h**2 / 2.0 + j * h**3 / 6.0,
            v1 + a1 * h + j * h**2 / 2.0,
            a1 + j * h,
        )
        if abs(a1) > axis.acceleration:
            return
    if axis.clip(v1, a1) != (v1, a1):
        return
    step = axis.towards(v, a, v1, a1)
    assert step.met
    assert (step.v, step.a) == (v1, a1)
    assert step.displacement == pytest.approx(p1, rel=1e-12, abs=1e-13)


def test_a_distant_target_is_not_met_until_it_is() -> None:
    axis, v, a, ticks = make(), 0.0, 0.0, 0
    while True:
        step = axis.towards(v, a, 5.0, 0.0)
        v, a, ticks = step.v, step.a, ticks + 1
        if step.met:
            break
    # the shortest way, jerk up, jerk down, and then a hundredth of a second that the end is eased
    shortest = 2.0 * np.sqrt(5.0 / JERK)
    assert shortest <= ticks * DT <= shortest + DT + 0.011
    assert (v, a) == (pytest.approx(5.0), pytest.approx(0.0, abs=1e-12))
    again = axis.towards(v, a, 5.0, 0.0)
    assert (again.v, again.a, again.met) == (5.0, 0.0, True)
    assert again.displacement == pytest.approx(5.0 * DT)


@pytest.mark.parametrize("dt", [1.0 / 1000.0, 1.0 / 500.0, 1.0 / 120.0])
@pytest.mark.parametrize("off", [0.4, 2.0, 4.0])
def test_a_target_that_moves_other_than_told_is_not_crossed_tick_by_tick(
    dt: float, off: float
) -> None:
    """Its acceleration is told wrongly; the way of least time would turn its full jerk round."""
    axis, v, a = make(dt), 0.0, [0.0]
    t = dt * np.arange(int(2.0 / dt))
    for speed, acceleration in zip(
        5.0 * np.sin(3.0 * t), 15.0 * np.cos(3.0 * t) + off, strict=True
    ):
        step = axis.towards(v, a[-1], speed, acceleration)
        v = step.v
        a.append(step.a)
        late = abs(speed - v)
    assert late < 0.1
    assert np.max(np.abs(np.diff(a)[int(0.5 / dt) :])) / dt < 0.5 * JERK


def test_the_same_question_has_the_same_answer() -> None:
    """`Ruckig.update` with an unchanged input goes on along its old plan; an Axis has no memory."""
    axis = make()
    first = axis.towards(1.0, 2.0, *FAR)
    axis.towards(-20.0, 30.0, -SPEED, 5.0)
    assert (
        axis.towards(1.0, 2.0, *FAR)
        == first
        == axis.towards(1.0, 2.0, *FAR)
        == make().towards(1.0, 2.0, *FAR)
    )
    assert not first.met


def refuse(error: Exception) -> Callable[..., Result]:
    def calculate(*_: object) -> Result:
        raise error

    return calculate


@pytest.mark.parametrize("error", [RuckigError("no"), ValueError("-100 is not a valid Result")])
def test_an_error_of_ruckig_leaves_nothing_stale(error: Exception) -> None:
    axis = make()
    expected = axis.towards(2.0, 1.0, *FAR)
    healthy = axis._generator
    axis._generator = SimpleNamespace(calculate=refuse(error))
    with pytest.raises(PlanningError, match=str(error)):
        axis.towards(-5.0, 3.0, *FAR)
    axis._generator = healthy
    assert axis.towards(2.0, 1.0, *FAR) == expected


def test_a_result_that_is_an_error_is_one() -> None:
    axis = make()
    axis._generator = SimpleNamespace(calculate=lambda *_: Result.ErrorInvalidInput)
    with pytest.raises(PlanningError, match="ErrorInvalidInput"):
        axis.towards(0.0, 0.0, *FAR)


@pytest.mark.parametrize(
    "lie",
    [
        {"p": nan},
        {"p": inf},
        {"v": 1.0 + 0.8 * JERK * DT**2},
        {"v": SPEED},
        {"v": nan},
        {"a": 1.01 * JERK * DT},
        {"a": -1.01 * JERK * DT},
        {"a": nan},
    ],
)
def test_an_answer_that_no_jerk_inside_the_limits_leads_to_is_refused(
    lie: dict[str, float],
) -> None:
    axis = make()
    honest = axis.towards(1.0, 0.0, *FAR)
    told = {"p": honest.displacement, "v": honest.v, "a": honest.a}
    pretend(axis, told)
    again = axis.towards(1.0, 0.0, *FAR)
    assert (again.displacement, again.v, again.a) == (honest.displacement, honest.v, honest.a)
    pretend(axis, told | lie)
    with pytest.raises(PlanningError, match="outside the limits"):
        axis.towards(1.0, 0.0, *FAR)


@pytest.mark.parametrize(("v", "a"), [(0.0, ACCELERATION), (SPEED - 0.5 * 40.0**2 / JERK, 40.0)])
def test_an_answer_beyond_the_limits_is_refused(v: float, a: float) -> None:
    """From the edge: too much acceleration, or a speed that cannot stay below its limit."""
    axis, more = make(), 0.1 * JERK * DT
    pretend(axis, {"p": v * DT, "v": v + (a + 0.5 * more) * DT, "a": a + more})
    with pytest.raises(PlanningError, match="outside the limits"):
        axis.towards(v, a, -SPEED, 0.0)


def pretend(axis: AxisSmoothing, told: dict[str, float]) -> None:
    """Let the generator say this."""
    axis._generator = SimpleNamespace(calculate=lambda *_: Result.Working)
    axis._trajectory = SimpleNamespace(
        duration=1.0, at_time=lambda _: ([told["p"]], [told["v"]], [told["a"]])
    )


@given(dts, st.lists(st.tuples(anything, anything), min_size=1, max_size=60))
def test_limits_hold_at_and_between_ticks_for_any_targets(
    dt: float, targets: list[tuple[float, float]]
) -> None:
    fly(Between(make(dt)), targets)


@pytest.mark.parametrize("dt", [1.0 / 1000.0, 1.0 / 120.0, 1.0 / 20.0])
def test_limits_hold_at_and_between_ticks_for_random_targets(dt: float) -> None:
    """Around the limits, where the clipping decides; all three ways to make a step are taken."""
    random = np.random.default_rng(11)
    between = Between(make(dt))
    targets = np.stack(
        [random.normal(0.0, SPEED, 1500), random.normal(0.0, 2.0 * ACCELERATION, 1500)], axis=1
    )
    targets = np.repeat(targets, random.integers(1, 6, len(targets)), axis=0)
    near = random.random(len(targets)) < 0.2
    wishes = [(nan, 0.0) if random.random() < 0.02 else tuple(t) for t in targets]
    fly(between, wishes, near.tolist())
    assert between.kinds["stop"] > 10
    assert between.kinds["halves"] > 100
    # in a short tick one jerk serves both halves, and the two agree
    assert between.kinds["ruckig"] > 20 or dt < 0.005


def test_a_step_that_no_jerk_inside_its_limit_leads_to_has_no_path() -> None:
    between = Between(make())
    v, a = 0.5 * JERK * DT * DT, JERK * DT
    assert between.path(0.0, 0.0, Step(v * DT / 3.0, v, a, False))[-1].tolist() == pytest.approx(
        [v * DT / 3.0, v, a]
    )
    for wrong in ((1.0, 1.001), (1.001, 1.0), (1.001, 1.001)):
        with pytest.raises(AssertionError, match="no motion inside the limits"):
            between.path(0.0, 0.0, Step(v * DT / 3.0, v * wrong[0], a * wrong[1], False))


def fly(
    between: Between, targets: list[tuple[float, float]], near: list[bool] | None = None
) -> None:
    """Fly towards each target for a tick (or near where the axis is going anyway).

    Check limits along every path.
    """
    v = a = 0.0
    axis, times, bound = between.axis, between.times, 1.0 + 1e-9
    for target, close in zip(targets, near or [False] * len(targets), strict=True):
        wish = (v + a * axis.dt, a) if close else target
        try:
            step = axis.towards(v, a, *wish)
        except PlanningError:
            step = axis.stopping(v, a)
        path = between.path(v, a, step)
        assert np.all(np.isfinite(path))
        assert np.max(np.abs(path[:, 1])) <= SPEED * bound
        assert np.max(np.abs(path[:, 2])) <= ACCELERATION * bound
        assert np.max(np.abs(np.diff(path[:, 2]))) <= JERK * axis.dt / 10.0 * (1.0 + 1e-6)
        mean = np.diff(path[:, 1]) - np.diff(times) * 0.5 * (path[1:, 2] + path[:-1, 2])
        assert np.max(np.abs(mean)) <= 0.25 * JERK * (axis.dt / 10.0) ** 2 * (1.0 + 1e-6) + 1e-12
        v, a = step.v, step.a


@given(st.floats(-SPEED, SPEED), st.floats(-1.0, 1.0))
def test_stopping_for_long_enough_stops(v: float, share: float) -> None:
    axis = make(1.0 / 20.0)
    a = share * min(ACCELERATION, np.sqrt(2.0 * JERK * (SPEED - abs(v))))
    for _ in range(40):
        step = axis.stopping(v, a)
        assert not step.met
        v, a = step.v, step.a
    assert (v, a) == (0.0, 0.0)
    assert axis.stopping(0.0, 0.0) == Step(0.0, 0.0, 0.0, False)


def test_the_cloud_is_never_called() -> None:
    """Setting `intermediate_positions` would; so nothing in the package may set or fill it."""
    files = list(Path(atlas_cueing.__file__).parent.rglob("*.py"))
    assert len(files) > 20
    used = re.compile(
        r"\.\s*intermediate_positions|setattr|per_section|add_via|RuckigCloud|Trackig"
    )
    found = [f.name for f in files if used.search(f.read_text())]
    assert found == []
    assert used.search("self._input.intermediate_positions = [[0.0]]")
    assert make()._input.intermediate_positions == []
    assert "intermediate_positions" in (axis_module.__doc__ or "")
