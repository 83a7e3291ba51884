"""The run's own account."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.review import RecordedRun
from atlas_cueing.review.checks.run_status import JUMP, check_status, state_notes
from atlas_cueing.review.own_rotations import from_vector, product

from ..runs import coning, with_flight, with_states


def jumped(angle: float) -> RecordedRun:
    """A vehicle that turns by so much at 3 s."""
    run = coning()
    q = run.flight.vehicle_q_NB.copy()
    q[300:] = product(q[300:], from_vector(np.tile([0.0, angle, 0.0], (301, 1))))
    return with_flight(run, replace(run.flight, vehicle_q_NB=q))


def test_a_calm_run() -> None:
    assert check_status(coning()) == []
    assert state_notes(coning()) == []


@pytest.mark.parametrize(("angle", "count"), [(0.9 * JUMP, 0), (1.1 * JUMP, 1), (3.0, 1)])
def test_a_jump_is_seen_from_its_bound_on(angle: float, count: int) -> None:
    found = check_status(jumped(angle))
    assert len(found) == count
    assert all(finding.time == pytest.approx(3.0) for finding in found)


@pytest.mark.parametrize(
    ("states", "count"),
    [
        (((0.0, "running", ""), (3.0, "attitude_jump", "!"), (3.01, "running", "")), 0),
        (((0.0, "running", ""), (2.0, "HOLDING", "stale")), 0),
        (((0.0, "running", ""), (3.0, "attitude_jump", "!"), (3.0, "done", "")), 0),
        (((0.0, "running", ""), (3.005, "attitude_jump", "too late")), 1),
        (((0.0, "running", ""), (2.0, "attitude_jump", ""), (2.5, "running", "over by then")), 1),
        ((), 1),
    ],
)
def test_a_jump_that_is_told_of_is_none(
    states: tuple[tuple[float, str, str], ...], count: int
) -> None:
    assert len(check_status(with_states(jumped(0.1), *states))) == count


@pytest.mark.parametrize(
    "state", ["vehicle_failed", "FAULT_STOPPING", "interrupted", "STOPPED", "failed"]
)
def test_states_of_failure(state: str) -> None:
    run = with_states(coning(), (0.0, "running", ""), (2.0, state, "why"))
    (found,) = check_status(run)
    assert str(found) == f"2.000000 s /status: fault: {state}: why"
    assert state_notes(run) == []


def test_the_result_is_told_once() -> None:
    run = with_states(coning(), (2.0, "vehicle_failed", "why"))
    failed = replace(
        run, log=replace(run.log, metadata={"result": "vehicle_failed", "reason": "why"})
    )
    assert [str(finding) for finding in check_status(failed)] == [
        "atlas.run: result: result = 'vehicle_failed', allowed: 'ok'; why"
    ]


def test_other_states_are_notes() -> None:
    run = with_states(
        coning(),
        (0.0, "running", ""),
        (1.0, "HOLDING", "input stale"),
        (2.0, "running", ""),
        (5.0, "PARKING", ""),
    )
    assert state_notes(run) == ["1.000000 to 2.000000 s HOLDING: input stale", "5.000000 s PARKING"]
    assert check_status(run) == []
