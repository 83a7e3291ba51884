"""The reference receiver after a ride: whom it follows next, and when only a reset helps."""

from dataclasses import replace

import pytest

from atlas_cueing.live.control.command import Command
from atlas_cueing.live.output.receiver import SetPointReceiver
from atlas_cueing.live.output.setpoint import encode
from atlas_cueing.signals import LIVE_STATES

from ..commands import REST
from ..control.guard_states import STAGE, WHEELS

FIRST, NEXT = ("127.0.0.1", 4001), ("127.0.0.1", 4002)
LEAD, SLOT, START = 18_000_000, 10_000_000, 10**12  # ns
PLACE = (1e-4, 0.0, -2e-4)  # m, where the ride before has ended
AT_REST = replace(REST, p_WS_W=PLACE, wheel_angle=(70.0, -3.0, 1.0))
PAUSE = 600_000_000  # ns
SHORT = 400_000_000  # ns


def packet(k: int, now: int, session: int, command: Command, state: str) -> bytes:
    return encode(session, k, 0.01 * k, now + LEAD, LIVE_STATES.index(state), command)


def after_a_ride(state: str) -> tuple[SetPointReceiver, int]:
    """A receiver that took a hundred standing set points, the last in this state."""
    receiver, now = SetPointReceiver(WHEELS, STAGE, b"", PLACE), START
    for k in range(100):
        now = START + k * SLOT
        assert receiver.take(packet(k, now, 7, AT_REST, state), FIRST, now) == ""
    return receiver, now


@pytest.mark.parametrize("sender", [FIRST, NEXT])
@pytest.mark.parametrize("angle", [(70.0, -3.0, 1.0), (0.0, 0.0, 0.0)])
def test_after_a_parked_end_it_follows_the_next_ride(
    sender: tuple[str, int], angle: tuple[float, float, float]
) -> None:
    """Which may count the wheels from another place."""
    receiver, now = after_a_ride("parked")
    command = replace(AT_REST, wheel_angle=angle)
    for k in range(200):
        now += PAUSE if k == 0 else SLOT
        state = "engaging" if k < 100 else "parked"
        assert receiver.take(packet(k, now, 8, command, state), sender, now) == ""
    assert receiver.state == ("following", "")
    assert receiver.newest is not None
    assert receiver.newest.session == 8
    told = receiver.report(now)
    assert told.command is not None
    assert (told.command.wheel_angle, told.good, told.refused) == (angle, 300, 0)
    assert "not ended parked" in receiver.take(packet(101, now, 7, AT_REST, "parked"), FIRST, now)


def test_a_ride_that_still_sends_is_not_replaced() -> None:
    receiver, now = after_a_ride("parked")
    other = packet(0, now + SHORT, 8, AT_REST, "parked")
    assert "from another sender" in receiver.take(other, NEXT, now + SHORT)
    now += SHORT
    assert receiver.take(packet(100, now, 7, AT_REST, "parked"), FIRST, now) == ""
    other = packet(1, now + SHORT, 8, AT_REST, "parked")
    assert "from another sender" in receiver.take(other, NEXT, now + SHORT)


@pytest.mark.parametrize("state", [state for state in LIVE_STATES if state != "parked"])
def test_after_any_other_end_only_a_reset_helps(state: str) -> None:
    """It stands there, but perhaps somebody hangs in it."""
    receiver, now = after_a_ride(state)
    now += 100 * PAUSE
    other = packet(0, now, 8, AT_REST, "parked")
    assert "not ended parked" in receiver.take(other, NEXT, now)
    receiver.reset(PLACE)
    assert receiver.take(other, NEXT, now) == ""


def test_after_a_latch_only_a_reset_helps() -> None:
    receiver, now = after_a_ride("running")
    jerk, h = 10.0, 0.01  # of wheel 1, from rest
    moving = replace(
        AT_REST,
        wheel_acceleration=(jerk * h, 0.0, 0.0),
        wheel_speed=(jerk * h**2 / 2.0, 0.0, 0.0),
        wheel_angle=(70.0 + jerk * h**3 / 6.0, -3.0, 1.0),
    )
    assert receiver.take(packet(100, now + SLOT, 7, moving, "running"), FIRST, now + SLOT) == ""
    now += PAUSE
    late = packet(101, now, 7, AT_REST, "parked")
    assert "not on its way to rest" in receiver.take(late, FIRST, now)
    now += 100 * PAUSE
    assert "reset first" in receiver.take(packet(0, now, 8, AT_REST, "parked"), NEXT, now)


@pytest.mark.parametrize(
    ("command", "ahead", "reason"),
    [
        (replace(AT_REST, p_WS_W=(0.0, 0.0, 0.0)), LEAD, "not stand where the drives do"),
        (replace(AT_REST, v_WS_W=(1e-9, 0.0, 0.0)), LEAD, "not stand where the drives do"),
        (AT_REST, -LEAD, "from another sender"),
        (AT_REST, 10 * LEAD, "ahead"),
    ],
)
def test_a_next_ride_that_does_not_begin_there_and_now_is_refused(
    command: Command, ahead: int, reason: str
) -> None:
    """As packets of an old session that somebody has kept."""
    receiver, now = after_a_ride("parked")
    now += PAUSE
    kept = packet(0, now + ahead - LEAD, 8, command, "parked")
    assert reason in receiver.take(kept, NEXT, now)
    assert receiver.take(packet(1, now, 9, AT_REST, "parked"), NEXT, now) == ""
