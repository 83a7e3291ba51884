"""The closed form against the solver, and its check of limits against the plan."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.cueing.stage.mpc_qp import MpcProblem
from cueing.stage.test_mpc_qp import DURATIONS, FADE, LIMITS, OMEGA, STATES, controls

PROBLEM = MpcProblem(DURATIONS, OMEGA, FADE, LIMITS)
State = tuple[float, float, float, float]


def numbers(most: float) -> st.SearchStrategy[float]:
    return st.floats(-most, most)


states = st.tuples(numbers(1.0), numbers(1.5), numbers(6.0), numbers(30.0))
mild = st.tuples(numbers(0.1), numbers(0.1), numbers(0.3), numbers(1.0))


@settings(max_examples=200, deadline=None)
@given(st.one_of(mild, states))
def test_a_free_plan_is_the_one_that_the_solver_finds(state: State) -> None:
    if PROBLEM.unlimited.is_free(state):
        found = PROBLEM._within_limits(state)
        assert found is not None
        assert PROBLEM.unlimited.plan(state).jerks == pytest.approx(found.jerks, abs=1e-9)


@settings(max_examples=300, deadline=None)
@given(st.one_of(mild, states))
def test_free_is_what_keeps_every_limit_and_nothing_else(state: State) -> None:
    """By a second derivation: control points of the simulated plan.

    The bound that settles most cases errs to neither side.
    """
    used = float(np.max(np.abs(controls(state, np.array(PROBLEM.unlimited.plan(state).jerks)))))
    if abs(used - 1.0) > 1e-9:
        assert PROBLEM.unlimited.is_free(state) == (used < 1.0)


def test_both_answers_occur() -> None:
    assert [PROBLEM.unlimited.is_free(state) for state in STATES] == [
        False,
        True,
        False,
        False,
        False,
        False,
    ]


def test_the_solver_is_asked_only_where_limits_matter() -> None:
    problem = MpcProblem(DURATIONS, OMEGA, FADE, LIMITS)
    problem._solver = None
    plan = problem.solve(*STATES[1])
    assert plan is not None
    assert plan.jerks == problem.unlimited.plan(STATES[1]).jerks
    assert plan.jerk(len(DURATIONS) - 1) == plan.jerks[-1]
    with pytest.raises(AttributeError):
        problem.solve(*STATES[2])
