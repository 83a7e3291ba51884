"""One tick of the controller: events, outcomes of a run, and that a tick never raises."""

from dataclasses import replace

import pytest

from atlas_cueing.errors import VehicleError
from atlas_cueing.live.control.state_machine import State

from ..rig import ROUNDING, Rig

QUICK = ("cueing.stage.planner=onset",)


def rig_in(state: State, **options: object) -> Rig:
    rig = Rig(settings=QUICK, **options)  # type: ignore[arg-type]
    rig.bring_to(state)
    return rig


def test_nothing_moves_before_a_second_of_good_input() -> None:
    rig = Rig(settings=QUICK)
    rig.source.quiet = True
    rig.press("engage")
    rig.fly(3.0)
    assert rig.state is State.WAITING
    assert not rig.platform.tracking
    rig.source.quiet = False
    assert 0.99 <= rig.until(lambda: rig.platform.tracking, 2.0) <= 1.03
    assert 2.9 <= rig.until(State.RUNNING, 6.0) <= 5.1


def test_trouble_while_waiting_makes_it_wait_again() -> None:
    rig = Rig(settings=QUICK)
    rig.press("engage")
    rig.fly(0.9)
    rig.source.jumps = True
    rig.tick()
    assert rig.state is State.ENGAGING
    assert 0.99 <= rig.until(lambda: rig.platform.tracking, 2.0) <= 1.03


def test_a_sources_own_time_goes_on_only_while_running() -> None:
    rig = rig_in(State.HOLDING)
    running = [timing.state == State.RUNNING.number for timing in rig.tape.timings]
    assert rig.source.advanced == running
    assert running.count(True) > 50


def test_the_sender_is_pinned_when_the_ride_sets_out() -> None:
    """Before, nobody has been heard perhaps; from home on, it may be another one."""
    rig = Rig(settings=QUICK)
    for ride in (1, 2):
        rig.press("engage")
        if ride == 1:
            rig.fly(0.5)
            assert (rig.source.released, rig.source.pinned) == (1, 0)
        rig.until(lambda: rig.platform.tracking, 2.0)
        assert (rig.source.released, rig.source.pinned) == (ride, ride)
        rig.press("park")
        rig.tick()
        rig.until(State.PARKED, 60.0)


def changes_of(rig: Rig) -> list[tuple[str, str]]:
    return [(state, reason) for _, state, reason in rig.tape.statuses]


def test_waiting_for_input_tells_why_and_the_reasons_that_follow() -> None:
    """Not more often than people read, and not again what was told."""
    rig = Rig(settings=QUICK)
    rig.source.quiet = True
    rig.source.remark = "nothing comes"
    rig.press("engage")
    assert 1.4 <= rig.until(State.WAITING, 3.0) <= 2.0
    assert changes_of(rig)[-1] == ("waiting", "nothing comes")
    begun = len(rig.tape.statuses)
    for _ in range(300):
        rig.source.remark = "version 25" if rig.source.remark == "size" else "size"
        rig.tick()
    assert 1 <= len(rig.tape.statuses) - begun <= 2
    rig.source.remark = "size"
    rig.fly(5.0)
    told = len(rig.tape.statuses)
    rig.fly(5.0)
    assert len(rig.tape.statuses) == told
    assert {state for state, _ in changes_of(rig)[begun:]} == {"waiting"}
    rig.source.quiet, rig.source.remark = False, "packets come at 15 Hz"
    rig.until(State.RUNNING, 9.0)
    rig.fly(1.0)
    assert [reason for _, reason in changes_of(rig)].count("packets come at 15 Hz") == 1
    assert rig.excess() <= ROUNDING


@pytest.mark.parametrize("end", ["signal", "duration"])
@pytest.mark.parametrize("after", [0.5, 4.0])
def test_a_ride_without_a_good_sample_is_one_that_lost_its_input(end: str, after: float) -> None:
    rig = Rig(settings=QUICK, attended=False)
    rig.source.quiet = True
    rig.source.remark = "nothing comes"
    rig.controller.engage()
    rig.fly(after)
    if end == "signal":
        rig.wanted.signals = 1
    else:
        rig.controller._operator = replace(rig.controller._operator, duration=0.0)
    rig.until(lambda: rig.controller.over, 60.0)
    outcome = rig.controller.outcome
    assert (outcome.result, outcome.reason) == ("input_lost", "no good input: nothing comes")


@pytest.mark.parametrize("duration", [0.0, 0.3, 0.99])
@pytest.mark.parametrize("quiet", [False, True])
def test_a_short_ride_tells_that_it_waits_if_nothing_came(duration: float, quiet: bool) -> None:
    rig = Rig(settings=QUICK, attended=False, duration=duration)
    rig.source.quiet = quiet
    rig.source.remark = "nothing comes" if quiet else ""
    rig.controller.engage()
    rig.until(lambda: rig.controller.over, 3.0)
    told = [("waiting", "no good input: nothing comes")] if quiet else []
    assert [change for change in changes_of(rig) if change[0] == "waiting"] == told
    assert rig.controller.outcome.result == ("input_lost" if quiet else "ok")


@pytest.mark.parametrize("carries", [False, True])
def test_a_late_tick_speaks_of_drives_only_where_there_are_some(carries: bool) -> None:
    rig = rig_in(State.RUNNING, carries=carries)
    rig.tick(lateness=0.025)
    assert ("drives" in changes_of(rig)[-1][1]) == carries
    assert "ms too late for" in changes_of(rig)[-1][1]


def test_nobody_asked_to_engage_and_nothing_came() -> None:
    rig = Rig(settings=QUICK)
    rig.source.quiet = True
    rig.fly(3.0)
    rig.wanted.signals = 1
    rig.until(lambda: rig.controller.over, 1.0)
    assert rig.controller.outcome.result == "ok"


def test_input_that_never_becomes_good_is_told() -> None:
    """As of a sender so slow that each packet comes after a gap."""
    rig = Rig(settings=QUICK, attended=False)
    rig.controller.engage()
    for _ in range(8):
        rig.source.jumps = True
        rig.fly(0.4)
    assert rig.state is State.WAITING
    assert changes_of(rig)[-1] == ("waiting", "the vehicle jumped: reset")
    rig.wanted.signals = 1
    rig.until(lambda: rig.controller.over, 60.0)
    assert rig.controller.outcome.result == "input_lost"


@pytest.mark.parametrize("button", ["park", "reset"])
def test_an_operators_hold_is_ended_by_engaging_only(button: str) -> None:
    """A reset while holding is no wish to go on."""
    rig = rig_in(State.HOLDING)
    rig.press(button)
    rig.fly(1.0)
    assert rig.state is (State.PARKING if button == "park" else State.HOLDING)
    if button == "reset":
        rig.press("engage")
        rig.until(State.RUNNING, 8.0)


def test_a_hold_of_the_input_can_be_made_the_operators() -> None:
    rig = rig_in(State.RUNNING)
    rig.source.jumps = True
    rig.tick()
    rig.press("hold")
    rig.fly(4.0)
    assert rig.state is State.HOLDING


def test_unknown_buttons_do_nothing() -> None:
    rig = Rig(settings=QUICK)
    rig.press("explode", "")
    rig.fly(0.1)
    assert rig.state is State.PARKED
    assert rig.controller.outcome.faults == 0


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
