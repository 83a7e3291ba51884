"""A ride at home before drives that are not ready: it has not moved, and is easily ended."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf

import pytest

from atlas_cueing.live.control.drive_status import DriveStatus
from atlas_cueing.live.control.pose import Pose
from atlas_cueing.live.control.state_machine import State
from atlas_cueing.rotation import exp

from .faults import DefectError
from .rig import Rig

QUICK = ("cueing.method=attitude", "cueing.stage.planner=onset")
# where a ride before this one has come to rest: home, but not to the last digit
NEARLY_HOME = Pose(exp((2e-5, 0.0, -1e-5)), (3.0, 1.0, -2.0), (1e-6, 0.0, 2e-5))
REFUSALS = {"another run": (8, "following"), "latched": (7, "latched"), "waiting": (0, "waiting")}


@dataclass
class RefusingDrives:
    """Drives that speak, and say that they will not follow."""

    followed: int
    state: str
    session = 7
    refusal = ""
    said = 0

    def statuses(self) -> Sequence[DriveStatus]:
        self.said += 1
        rest = (0.0, 0.0, 0.0)
        return [
            DriveStatus(
                *(self.said, self.state, "why", 0, self.followed, 1, inf, b"", rest, rest, 1, 0)
            )
        ]


def refused(refusal: str, *, attended: bool = False) -> Rig:
    return Rig(
        0.02,
        settings=QUICK,
        attended=attended,
        carries=True,
        pose=NEARLY_HOME,
        feedback=RefusingDrives(*REFUSALS[refusal]),
    )


@pytest.mark.parametrize("refusal", REFUSALS)
@pytest.mark.parametrize("state", [State.ENGAGING, State.WAITING, State.HOLDING])
@pytest.mark.parametrize("attended", [False, True])
def test_one_request_ends_it_and_nothing_moves(refusal: str, state: State, attended: bool) -> None:
    rig = refused(refusal, attended=attended)
    rig.source.quiet = state is State.WAITING
    rig.controller.engage()
    rig.fly(3.0)
    if state is State.HOLDING:
        rig.press("hold")
        rig.fly(0.5)
    assert rig.state is state
    rig.wanted.signals = 1
    rig.until(lambda: rig.controller.over, 3.0)
    assert (rig.state, rig.controller.outcome.faults) == (State.PARKED, 0)
    assert {command.wheel_angle for command in rig.tape.commands} == {NEARLY_HOME.wheel_angle}
    assert {command.p_WS_W for command in rig.tape.commands} == {NEARLY_HOME.p_WS_W}


@pytest.mark.parametrize("attended", [False, True])
def test_a_fault_at_home_after_the_request_needs_no_second(attended: bool) -> None:
    rig = refused("another run", attended=attended)
    rig.controller.engage()
    rig.fly(1.0)
    rig.wanted.signals = 1
    rig.source.raises = DefectError("source")
    rig.until(lambda: rig.controller.over, 3.0)
    assert (rig.state, rig.controller.outcome.result) == (State.STOPPED, "fault")


@pytest.mark.parametrize("attended", [False, True])
def test_a_request_while_a_fault_stops_it_counts(attended: bool) -> None:
    rig = Rig(0.02, settings=QUICK, attended=attended, carries=True, rate=0.9)
    rig.bring_to(State.RUNNING)
    rig.source.raises = DefectError("source")
    rig.tick()
    rig.wanted.signals = 1
    rig.until(lambda: rig.controller.over, 3.0)
    assert rig.state is State.STOPPED
