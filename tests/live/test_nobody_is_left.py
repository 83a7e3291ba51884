"""An unattended run with drives that stopped: slowly home, or there until it is asked to end."""

from dataclasses import replace
from math import inf

import pytest

from atlas_cueing.live.control.homecoming import HOME_AFTER
from atlas_cueing.live.control.pose import Pose
from atlas_cueing.live.control.state_machine import State
from atlas_cueing.rotation import IDENTITY, exp, geodesic

from .faults import DefectError
from .rig import ROUNDING, Rig

QUICK = ("cueing.method=attitude", "cueing.stage.planner=onset")
AWAY = Pose(exp((2.0, 0.5, 0.0)), (1.0, -70.0, 3.5), (0.1, -0.2, 0.05))


def carrying(pose: Pose | None = None, *, duration: float = inf) -> Rig:
    return Rig(
        0.02, settings=QUICK, attended=False, carries=True, pose=pose, duration=duration, rate=0.9
    )


def stopped_by_lateness(**options: float) -> Rig:
    rig = carrying(**options)  # type: ignore[arg-type]
    rig.bring_to(State.STOPPED)
    assert geodesic(rig.motion.q_WS, IDENTITY) > 0.3
    return rig


def test_after_lateness_it_goes_slowly_home_and_is_over() -> None:
    rig = stopped_by_lateness(duration=1.0e9)
    assert "moves after 5 punctual s" in rig.tape.statuses[-1][2]
    rig.fly(HOME_AFTER - 0.1)
    assert rig.state is State.STOPPED
    assert not rig.controller.over
    begun = len(rig.tape.ticks)
    rig.until(lambda: rig.controller.over, 30.0)
    assert rig.state is State.PARKED
    assert rig.controller.outcome.result == "fault"
    assert geodesic(rig.motion.q_WS, IDENTITY) < 1e-5
    rates = [max(map(abs, tick.motion.w_WS_W)) for tick in rig.tape.ticks[begun:]]
    assert max(rates) <= 0.5 * 1.05 + 1e-3, "30 deg/s"
    assert rig.excess() <= ROUNDING


def test_the_seconds_begin_anew_with_each_late_slot() -> None:
    rig = stopped_by_lateness()
    for _ in range(3):
        rig.fly(HOME_AFTER - 1.0)
        rig.tick(lateness=0.025)
    assert rig.state is State.STOPPED
    rig.fly(HOME_AFTER + 0.1)
    assert rig.state is State.PARKING


def test_late_on_the_way_home_it_stops_and_tries_again() -> None:
    rig = stopped_by_lateness()
    rig.until(State.PARKING, 6.0)
    rig.fly(1.0)
    rig.tick(lateness=0.025)
    assert rig.state is State.FAULT_STOPPING
    rig.until(State.STOPPED, 3.0)
    rig.fly(HOME_AFTER - 0.1)
    assert rig.state is State.STOPPED, "the punctual seconds before do not count"
    rig.until(lambda: rig.controller.over, 30.0)
    assert (rig.state, rig.controller.outcome.faults) == (State.PARKED, 2)


@pytest.mark.parametrize("late_too", [False, True])
def test_after_another_fault_it_stays_until_a_signal(late_too: bool) -> None:
    """Also when the run was to end anyway, by its duration."""
    rig = carrying(duration=8.0)
    rig.bring_to(State.RUNNING)
    rig.source.raises = DefectError("source")
    rig.tick()
    rig.source.raises = None
    if late_too:
        rig.tick(lateness=0.025)
    rig.until(State.STOPPED, 3.0)
    stands = rig.tape.commands[-1]
    rig.fly(20.0)
    assert (rig.state, rig.controller.over) == (State.STOPPED, False)
    assert replace(rig.tape.commands[-1], time=0.0) == replace(stands, time=0.0)
    rig.wanted.signals = 1
    rig.tick()
    assert rig.controller.over
    assert rig.controller.outcome.result == "fault"


def test_a_signal_before_the_fault_does_not_end_it_the_next_one_does() -> None:
    """Asked to end, it was on its way home, where nobody hangs; it did not get there."""
    rig = carrying()
    rig.bring_to(State.RUNNING)
    rig.wanted.signals = 1
    rig.fly(0.3)
    rig.source.raises = DefectError("source")
    rig.tick()
    rig.until(State.STOPPED, 3.0)
    rig.fly(10.0)
    assert not rig.controller.over
    rig.wanted.signals = 2
    rig.tick()
    assert rig.controller.over


def test_two_signals_stop_it_and_end_it() -> None:
    rig = carrying()
    rig.bring_to(State.RUNNING)
    rig.wanted.signals = 2
    rig.until(lambda: rig.controller.over, 3.0)
    assert rig.controller.outcome.result == "stopped"


def test_from_a_pose_it_stands_there_until_a_reset_brings_it_home() -> None:
    rig = carrying(AWAY)
    rig.fly(10.0)
    assert (rig.state, rig.controller.over) == (State.STOPPED, False)
    first, last = rig.tape.commands[0], rig.tape.commands[-1]
    assert (first.wheel_angle, first.p_WS_W) == (AWAY.wheel_angle, AWAY.p_WS_W)
    assert replace(last, time=first.time) == first
    rig.press("reset")
    rig.until(lambda: rig.controller.over, 30.0)
    assert rig.controller.outcome.result == "ok"
    assert geodesic(rig.motion.q_WS, IDENTITY) < 1e-5
    angle = rig.tape.commands[-1].wheel_angle
    assert all(abs(a - b) > 1e-3 for a, b in zip(angle, AWAY.wheel_angle, strict=True))
    assert rig.excess() <= ROUNDING


def test_from_a_pose_a_signal_ends_it_where_it_stands() -> None:
    rig = carrying(AWAY)
    rig.fly(1.0)
    rig.wanted.signals = 1
    rig.tick()
    assert rig.controller.over
    assert rig.controller.outcome.result == "stopped"
    assert "away from home" in rig.controller.outcome.reason


def test_without_drives_a_fault_ends_the_run_as_ever() -> None:
    rig = Rig(0.02, settings=QUICK, attended=False)
    rig.bring_to(State.STOPPED)
    assert rig.controller.over
