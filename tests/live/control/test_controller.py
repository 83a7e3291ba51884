"""One tick of the controller: input, reasons, and buttons."""

from dataclasses import replace

import pytest

from atlas_cueing.live.control.state_machine import State

from ..rig import ROUNDING, Rig
from .controller_rigs import QUICK, changes_of, rig_in


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
