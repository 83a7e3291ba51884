"""One axis of the stage by plans: inside its limits, useful on onsets, else still."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing import MpcParameters
from atlas_cueing.cueing.stage.high_pass import HighPass
from atlas_cueing.cueing.stage.mpc import MpcAxis, block_ticks, planning_ticks
from atlas_cueing.cueing.stage.mpc_qp import MpcProblem

DT = 1.0 / 120.0
LIMITS = (1.0, 1.5, 6.0, 60.0)
SMALL = (0.05, 0.2, 2.0, 40.0)
NARROW = (1e-9, 1e-9, 1e-9, 1e-9)
"""Limits that every plan without them breaks."""
DEFAULT = MpcParameters()
EAGER = replace(DEFAULT, first_share=1.0, doubt=1e12, excess=100.0)
"""Moves for the whole demand, whatever comes of it, and well into the limits."""


def axis(
    dt: float = DT, limits: tuple[float, float, float, float] = LIMITS, **changes: Any
) -> MpcAxis:
    return MpcAxis(dt, 0.7, 0.2, 5.0, limits, replace(EAGER, **changes), 0)


def fly(moved: MpcAxis, demands: Any) -> np.ndarray:
    """p, v, a before and after each tick, a row each; from rest in the centre."""
    return np.array([(0.0, 0.0, 0.0), *(moved.step(float(demand)) for demand in demands)])


def watched(
    moved: MpcAxis, demands: Any, before: Any = (0.0, 0.0, 0.0)
) -> tuple[np.ndarray, list[int]]:
    """What `fly` gives, from the state before, and the ticks in which a new plan was begun."""
    path, begun = [tuple(before)], []
    for tick, demand in enumerate(demands):
        flown = moved._flown
        path.append(moved.step(float(demand)))
        if moved._flown is not None and moved._flown is not flown:
            begun.append(tick)
    return np.array(path), begun


class Unreliable:
    """A solver that fails every so many times it is asked."""

    def __init__(self, solver: Any, every: int) -> None:
        self._every, self.asked, self.failed, self.solve = every, 0, 0, solver.solve
        self._update = solver.update

    def update(self, **problem: np.ndarray) -> int:
        self.asked += 1
        if self.asked % self._every:
            return int(self._update(**problem))
        self.failed += 1
        return -1


@contextmanager
def failing(problem: MpcProblem, every: int) -> Iterator[Unreliable]:
    """The problem with an unreliable solver, which is asked for every plan."""
    kept, narrow = (problem._solver, problem.unlimited), MpcProblem([1.0] * 3, 1.0, 1.0, NARROW)
    problem._solver, problem.unlimited = Unreliable(problem._solver, every), narrow.unlimited
    yield problem._solver
    problem._solver, problem.unlimited = kept


def wild(seed: int, ticks: int) -> np.ndarray:
    """Steps, sines and noise of all sizes and lengths."""
    random = np.random.default_rng(seed)
    pieces: list[np.ndarray] = [np.zeros(1)]
    while sum(map(len, pieces)) < ticks:
        n, size = int(random.integers(1, 400)), 10.0 ** random.uniform(-2.0, 6.0)
        t = np.arange(n) * DT
        shapes = (
            np.full(n, random.choice([-1.0, 1.0])),
            np.sin(10.0 ** random.uniform(-1.0, 2.0) * t),
            random.standard_normal(n),
        )
        pieces.append(size * shapes[random.integers(3)])
    return np.concatenate(pieces)[:ticks]


def between(path: np.ndarray, dt: float) -> np.ndarray:
    """p, v, a (n, 3) at nine instants of each tick, the jerk being constant over it.

    And that its ends fit.
    """
    p, v, a = path[:-1, :, None].transpose(1, 0, 2)
    jerk = np.diff(path[:, 2])[:, None] / dt
    t = np.linspace(0.0, dt, 9)
    inside = p + t * v + t**2 * a / 2 + t**3 * jerk / 6, v + t * a + t**2 * jerk / 2, a + t * jerk
    assert np.max(np.abs(inside[0][:, -1] - path[1:, 0])) < 1e-6 * np.max(np.abs(path[:, 0]) + dt)
    assert np.max(np.abs(inside[1][:, -1] - path[1:, 1])) < 1e-5 * np.max(np.abs(path[:, 1]) + dt)
    return np.stack([x.ravel() for x in inside], axis=1)


@pytest.mark.parametrize(
    ("dt", "limits"), [(DT, LIMITS), (DT, SMALL), (1e-3, LIMITS), (0.05, LIMITS)]
)
def test_all_limits_hold_between_ticks_too_and_no_plan_is_missing(
    dt: float, limits: tuple[float, float, float, float]
) -> None:
    """Thousands of plans for demands without any sense; the limits are used up to their share."""
    moved = axis(dt, limits)
    path, begun = watched(moved, wild(11, 8000))
    used = np.max(np.abs(between(path, dt)), axis=0) / limits[:3]
    assert np.all(used <= 1.0), used
    assert np.max(used) > 0.99
    assert np.max(np.abs(np.diff(path[:, 2]))) <= dt * limits[3] * (1.0 + 1e-9)
    assert begun == list(range(0, 8000, planning_ticks(dt, 50.0)))


@pytest.mark.parametrize("ticks", [1, 37, 160, 1001])
def test_without_new_plans_it_goes_on_to_a_standstill_inside_the_limits(ticks: int) -> None:
    """The solver fails from some tick on, under full demand; afterwards it is back."""
    moved, demand = axis(), wild(5, 1400)
    path = fly(moved, demand[:ticks])
    with failing(moved.problem, every=1) as solver:
        tail, begun = watched(moved, [1e3] * int(6.0 / DT), path[-1])
    assert (begun, solver.failed) == ([], solver.asked)
    assert solver.asked == len(range(-ticks % 2, int(6.0 / DT), 2))
    assert np.all(np.max(np.abs(between(tail, DT)), axis=0) <= LIMITS[:3])
    assert np.max(np.abs(np.diff(tail[:, 2]))) <= DT * LIMITS[3] * (1.0 + 1e-9)
    assert tuple(tail[-1][1:]) == (0.0, 0.0)
    assert np.all(tail[-50:] == tail[-1])
    back = np.array([moved.step(0.0) for _ in range(int(60.0 / DT))])
    assert abs(back[-1][0]) < 0.02
    assert np.all(np.max(np.abs(back), axis=0) <= LIMITS[:3])


def test_one_failure_now_and_then_goes_unnoticed_but_for_the_plan_s_age() -> None:
    """Without every third plan the stage stays inside all limits.

    A plan then begins in the middle of the one before.
    """
    moved = axis()
    with failing(moved.problem, every=3) as solver:
        path, begun = watched(moved, wild(7, 6000))
    assert np.all(np.max(np.abs(between(path, DT)), axis=0) <= LIMITS[:3])
    assert (solver.asked, solver.failed) == (2999, 999)  # the first demand is none
    assert len(begun) == 2001


def test_far_from_the_limits_it_is_the_onset_filter() -> None:
    """A second derivation: the completed square, but for jerk limit and blocks."""
    t = np.arange(0.0, 20.0, DT)
    demand = 0.1 * np.sin(0.8 * t) + 0.1 * np.sin(2.5 * t + 1.0) * (t > 5.0)
    planned = fly(axis(), demand)[1:]
    onset = HighPass(DT, 0.7, 0.2, 5.0, 1e9)
    expected = np.array([onset.step(d) for d in demand.tolist()])
    error = np.sqrt(np.mean((planned - expected) ** 2, axis=0) / np.mean(expected**2, axis=0))
    assert np.all(error < 0.06), error


def ratio(demand: np.ndarray, parameters: MpcParameters = DEFAULT) -> float:
    """Rms error with the stage over that without."""
    moved = MpcAxis(DT, 0.7, 0.2, 5.0, LIMITS, parameters, 0)
    left = demand - fly(moved, demand)[1:, 2]
    return float(np.sqrt(np.mean(left**2) / np.mean(demand**2)))


def test_onsets_are_felt() -> None:
    """Pushes of half a second to and fro, each minute a few: most of it is given.

    A single push, part of it.
    """
    t = np.arange(0.0, 60.0, DT)
    swaying = np.sin(2.0 * np.pi * t / 2.0)
    assert ratio(swaying) < 0.6
    single = np.where((t > 1.0) & (t < 1.5), 1.0, 0.0)
    assert ratio(single) < 0.9


@pytest.mark.parametrize("period", [40.0, 80.0])
def test_it_keeps_still_where_the_demand_lasts(period: float) -> None:
    """For demands of 1 m/s^2 that stay for 20 s any motion adds to the error."""
    t = np.arange(0.0, 240.0, DT)
    lasting = np.where(np.sin(2.0 * np.pi * t / period) >= 0.0, 1.0, -1.0) * (t > 1.0)
    slow = np.sin(2.0 * np.pi * t / period)
    always = replace(DEFAULT, first_share=1.0, doubt=1e12)
    for demand in (lasting, slow):
        assert ratio(demand) < 1.01
        assert ratio(demand) < ratio(demand, always)


def test_nothing_asked_or_always_asked_is_nothing_done() -> None:
    for demand in (0.0, 3.0):
        assert not np.any(fly(axis(), [demand] * 300))


def test_the_same_demands_give_the_same_bits() -> None:
    demand = wild(3, 1500)
    assert np.array_equal(fly(axis(), demand), fly(axis(), demand))


@given(st.floats(1e-4, 0.5), st.floats(10.0, 1000.0))
def test_plans_come_at_the_rate_asked_for_where_ticks_allow_it(dt: float, rate: float) -> None:
    ticks = planning_ticks(dt, rate)
    assert ticks == 1 or ticks * dt <= (1.0 + 1e-6) / rate
    assert (ticks + 1) * dt > 1.0 / rate * (1.0 - 1e-6)


def test_common_rates() -> None:
    assert [planning_ticks(1.0 / hz, 50.0) for hz in (20, 50, 100, 120, 500, 1000)] == [
        1,
        1,
        2,
        2,
        10,
        20,
    ]


@given(st.integers(1, 50), st.floats(1.0, 1e5), st.integers(2, 30))
def test_blocks_are_whole_planning_periods_of_about_the_horizon(
    period: int, horizon: float, blocks: int
) -> None:
    ticks = block_ticks(period, horizon, blocks)
    assert len(ticks) == blocks
    assert ticks[0] == period or horizon / period > 1.6**blocks
    assert all(each >= period and each % period == 0 for each in ticks)
    assert sum(ticks) <= max(horizon + period, blocks * period)
    if horizon > 4.0 * blocks * period:
        assert sum(ticks) == pytest.approx(horizon, abs=period)
        assert all(later >= earlier - period for earlier, later in pairwise(ticks))


def test_the_first_block_of_the_defaults_is_one_period() -> None:
    for hz in (50.0, 120.0, 1000.0):
        period = planning_ticks(1.0 / hz, DEFAULT.planning_rate)
        assert block_ticks(period, DEFAULT.length * hz, DEFAULT.blocks)[:2] == [period, period]


def test_a_late_start_shifts_the_plans() -> None:
    first = []
    for delay in (0, 1, 2, 5):
        _, begun = watched(MpcAxis(1e-3, 0.7, 0.2, 5.0, LIMITS, EAGER, delay), [1.0] * 100)
        assert set(np.diff(begun)) == {20}
        first.append(begun[0])
    assert first == [0, 1, 2, 5]
