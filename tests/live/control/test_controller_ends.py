"""How a run of the controller ends; a tick never raises."""

from dataclasses import replace

import pytest

from atlas_cueing.errors import VehicleError
from atlas_cueing.live.control.state_machine import State

from ..rig import ROUNDING, Rig
from .controller_rigs import QUICK, changes_of, rig_in


class SilentError(BaseException):
    """Nothing that code for errors expects, and it cannot even be shown."""

    def __str__(self) -> str:
        raise ValueError("no words")


THROWN = {
    "RuntimeError: gone": RuntimeError("gone"),
    "SystemExit: 3": SystemExit(3),
    "KeyboardInterrupt: ": KeyboardInterrupt(),
    "GeneratorExit: ": GeneratorExit(),
    "SilentError": SilentError(),
}


STATES = [state for state in State if state not in (State.FAULT_STOPPING, State.STOPPED)]


@pytest.mark.parametrize(("state", "reason"), list(zip(STATES, THROWN, strict=False)))
def test_a_vehicle_that_throws_ends_in_a_certified_stop(state: State, reason: str) -> None:
    """Whatever it throws; an unattended run ends there."""
    rig = rig_in(state, attended=False)
    rig.source.raises = THROWN[reason]
    rig.tick()
    assert rig.state is State.FAULT_STOPPING
    rig.until(lambda: rig.controller.over, 2.0)
    outcome = rig.controller.outcome
    assert (rig.state, outcome.result, outcome.faults) == (State.STOPPED, "fault", 1)
    assert outcome.reason == reason
    assert rig.excess() <= ROUNDING


def test_a_vehicle_that_throws_is_not_asked_again_and_a_reset_leads_home() -> None:
    rig = rig_in(State.RUNNING, attended=True)
    rig.source.raises = RuntimeError("gone")
    rig.tick()
    rig.until(State.STOPPED, 2.0)
    rig.fly(1.0)
    assert not rig.controller.over
    rig.press("reset")
    rig.until(State.PARKED, 60.0)
    rig.until(lambda: rig.controller.over, 2.0)
    outcome = rig.controller.outcome
    assert (outcome.result, outcome.reason, outcome.faults) == ("fault", "RuntimeError: gone", 1)
    assert rig.excess() <= ROUNDING


def begin_to_end(rig: Rig, cause: str) -> None:
    """What sends an attended run home for good."""
    if cause == "signal":
        rig.wanted.signals = 1
    elif cause == "flight":
        rig.source.over = True
    else:
        rig.controller._operator = replace(rig.controller._operator, duration=0.0)
    rig.until(State.PARKING, 0.1)
    rig.fly(0.8)


CAUSES = ("signal", "duration", "flight")


@pytest.mark.parametrize("cause", CAUSES)
@pytest.mark.parametrize("then", ["reset", "signal"])
def test_a_fault_on_the_last_way_home_waits_for_its_reset(cause: str, then: str) -> None:
    """Or for another request to end."""
    rig = rig_in(State.RUNNING)
    begin_to_end(rig, cause)
    rig.tick(lateness=0.025)
    rig.until(State.STOPPED, 3.0)
    rig.fly(3.0)
    assert not rig.controller.over
    if then == "signal":
        rig.wanted.signals += 1
        rig.tick()
        assert rig.controller.over
        assert rig.state is State.STOPPED
    else:
        rig.press("reset")
        rig.until(lambda: rig.controller.over, 60.0)
        assert rig.state is State.PARKED
    assert rig.controller.outcome.result == "fault"
    assert rig.excess() <= ROUNDING


@pytest.mark.parametrize("attended", [False, True])
def test_two_requests_to_end_wait_for_nobody(attended: bool) -> None:
    rig = rig_in(State.RUNNING, attended=attended)
    rig.wanted.signals = 2
    rig.until(lambda: rig.controller.over, 3.0)
    assert (rig.state, rig.controller.outcome.result) == (State.STOPPED, "stopped")


@pytest.mark.parametrize("cause", CAUSES)
def test_an_operators_hold_outlasts_the_input_but_not_the_run(cause: str) -> None:
    rig = rig_in(State.HOLDING)
    rig.source.quiet = True
    rig.fly(5.0)
    assert rig.state is State.HOLDING
    begin_to_end(rig, cause)
    rig.until(lambda: rig.controller.over, 60.0)
    assert (rig.state, rig.controller.outcome.result) == (State.PARKED, "ok")


def test_the_vehicle_in_the_log_stays_where_it_was_when_a_source_breaks() -> None:
    rig = rig_in(State.RUNNING)
    known = rig.tape.ticks[-1].vehicle
    rig.source.raises = RuntimeError("gone")
    rig.tick()
    assert rig.tape.ticks[-1].vehicle.q_NB == known.q_NB
    assert rig.tape.ticks[-1].vehicle.f_B == known.f_B


def test_a_vehicle_that_fails_ends_the_run_parked() -> None:
    rig = rig_in(State.RUNNING, attended=False)
    rig.source.bad = 2
    rig.fly(0.02)
    rig.source.raises = VehicleError(1.25, "diverged")
    rig.tick()
    assert rig.state is State.PARKING
    rig.until(lambda: rig.controller.over, 60.0)
    assert (rig.controller.outcome.result, rig.controller.outcome.faults) == ("vehicle_failed", 0)
    assert rig.controller.outcome.reason == "vehicle failed at 1.250 s: diverged"
    assert rig.controller.outcome.dropped == 2


def test_the_end_of_the_flight_is_the_end_of_the_run() -> None:
    rig = rig_in(State.RUNNING, attended=False)
    rig.source.over = True
    rig.until(lambda: rig.controller.over, 60.0)
    assert rig.state is State.PARKED
    assert rig.controller.outcome.result == "ok"
    assert rig.tape.statuses[-2][2] == "the run is over"


def test_a_duration_parks() -> None:
    rig = Rig(settings=QUICK, attended=False, duration=7.0)
    rig.press("engage")
    assert 7.0 <= rig.until(State.PARKING, 8.0) <= 7.02
    rig.until(lambda: rig.controller.over, 60.0)
    assert rig.controller.outcome.result == "ok"


def test_input_lost_ends_an_unattended_run_and_not_an_attended_one() -> None:
    for attended in (False, True):
        rig = rig_in(State.RUNNING, attended=attended)
        rig.source.quiet = True
        rig.until(State.PARKED, 60.0)
        assert rig.controller.over != attended
        assert rig.controller.outcome.result == ("ok" if attended else "input_lost")
    rig.source.quiet = False
    rig.press("engage")
    rig.until(State.RUNNING, 8.0)


def test_what_was_dropped_is_counted() -> None:
    rig = rig_in(State.RUNNING)
    rig.source.bad = 2
    rig.fly(0.1)
    assert rig.controller.outcome.dropped == 2
    assert rig.state is State.RUNNING


def test_the_first_reason_is_the_one_that_is_kept() -> None:
    rig = rig_in(State.RUNNING, attended=False)
    rig.source.raises = VehicleError(1.0, "diverged")
    rig.tick()
    rig.tick(lateness=0.5)
    rig.until(lambda: rig.controller.over, 2.0)
    assert rig.controller.outcome.result == "vehicle_failed"
    assert rig.controller.outcome.faults == 1


def test_a_vehicle_of_the_other_sign_does_not_tear_the_log() -> None:
    rig = Rig(settings=QUICK)
    rig.source.quiet = True
    rig.fly(0.05)
    rig.source.q = (-1.0, 0.0, 0.0, 0.0)
    rig.source.quiet = False
    rig.fly(0.05)
    assert all(tick.vehicle.q_NB[0] > 0.9 for tick in rig.tape.ticks)


@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("attended", [False, True])
def test_the_operator_stops_it_at_once(state: State, attended: bool) -> None:
    rig = rig_in(state, attended=attended)
    rig.press("stop")
    rig.tick()
    assert rig.state is State.FAULT_STOPPING
    rig.until(State.STOPPED, 2.0)
    rig.fly(0.5)
    assert rig.controller.over != attended
    outcome = rig.controller.outcome
    assert (outcome.result, outcome.reason) == ("stopped", "asked to stop")
    assert rig.excess() <= ROUNDING


def test_an_unattended_run_that_is_asked_to_park_ends_well() -> None:
    rig = rig_in(State.RUNNING, attended=False)
    rig.press("park")
    rig.until(lambda: rig.controller.over, 60.0)
    assert (rig.state, rig.controller.outcome.result) == (State.PARKED, "ok")


@pytest.mark.parametrize("state", State)
@pytest.mark.parametrize("parks", [False, True])
def test_a_dead_helper_is_told_and_the_view_takes_the_ride_home(state: State, parks: bool) -> None:
    rig = rig_in(state)
    losses = [("it has died", parks)]
    rig.controller._operator = replace(
        rig.controller._operator, losses=lambda: [losses.pop()] if losses else []
    )
    rig.tick()
    assert [reason for _, reason in changes_of(rig)].count("it has died") == 1
    if not parks:
        rig.fly(0.5)
        assert not rig.controller.over
        return
    rig.until(lambda: rig.controller.over, 60.0)
    faulted = state in (State.FAULT_STOPPING, State.STOPPED)
    assert rig.state is (State.STOPPED if faulted else State.PARKED)
    assert rig.controller.outcome.result == ("fault" if faulted else "viewer_died")
    assert rig.excess() <= ROUNDING
