"""What the drives' words mean: a fault while the platform moves, a reason to stay at rest."""

from dataclasses import replace
from math import inf, nan, radians

import pytest

from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.drive_monitor import DriveMonitor
from atlas_cueing.live.control.drive_status import DriveStatus
from atlas_cueing.rotation import ZERO

from ..commands import REST, swinging

MS = 1_000_000  # ns
LIMITS = bytes(16)
GOOD = DriveStatus(1, "following", "", 0, 7, 1, 0.009, LIMITS, ZERO, ZERO, 1, 0)


class Words:
    """What the drives say, as it comes."""

    session = 7
    refusal = ""

    def __init__(self) -> None:
        self.new: list[DriveStatus] = []

    def statuses(self) -> list[DriveStatus]:
        new, self.new = self.new, []
        return new


class Watched:
    """A monitor, with a loop of 10 ms whose drives do as they are told, 15 ms later."""

    def __init__(self) -> None:
        self.words = Words()
        self.monitor = DriveMonitor(self.words, LIMITS)
        self.slot = 0
        self.commands: dict[int, Command] = {}

    def tick(self, command: Command | None = None, **said: object) -> str:
        """One slot: what the drives say now (nothing for `silent`), and the next command."""
        self.slot += 1
        now = self.slot * 10 * MS
        told = self.commands.get(now)
        if "silent" not in said:
            here = {"number": self.slot, "time": now}
            here |= {"wheel_angle": told.wheel_angle, "p_WS_W": told.p_WS_W} if told else {}
            new = replace(GOOD, **{**here, **said})  # type: ignore[arg-type]
            self.words.new.append(new)
        fault = self.monitor.watch(1e-9 * now, tracking=False)
        command = command or moving(self.slot)
        self.commands[now + 20 * MS] = command
        self.monitor.commanded(now + 20 * MS, command)
        return fault


def moving(slot: int) -> Command:
    return swinging(0.01 * slot)


def in_motion() -> Watched:
    watched = Watched()
    assert not any(watched.tick() for _ in range(50))
    return watched


def test_drives_that_do_as_they_are_told_are_no_fault() -> None:
    watched = in_motion()
    assert watched.monitor.trouble == ""
    assert watched.monitor.wheel_difference < 1e-9
    assert watched.monitor.stage_difference < 1e-9
    assert watched.monitor.notes() == []


@pytest.mark.parametrize(
    ("said", "fault"),
    [
        ({"state": "latched", "reason": "late"}, "the drives have latched: late; reset them"),
        (
            {"followed": 8},
            "the drives follow the set points of another run; wait until that has ended parked, or"
            " reset them",
        ),
        ({"state": "waiting", "followed": 0}, "the drives wait for a first set point"),
    ],
)
def test_a_word_that_says_otherwise_is_a_fault_at_once_while_it_moves(
    said: dict[str, object], fault: str
) -> None:
    assert in_motion().tick(**said) == fault
    watched = Watched()
    assert not any(watched.tick(REST, **said) for _ in range(150)), "at rest it is none"
    assert watched.monitor.trouble == fault
    assert watched.monitor.finding == fault
    assert watched.monitor.notes() == [fault]


def test_silence_is_a_fault_after_the_timeout() -> None:
    watched = in_motion()
    assert [watched.tick(silent=True) for _ in range(4)] == [""] * 4
    watched.tick(silent=True)
    assert watched.tick(silent=True) == "the drives were silent for 60 ms, allowed: 50 ms"


@pytest.mark.parametrize("wheels", [True, False])
def test_a_position_that_is_off_is_a_fault(wheels: bool) -> None:
    """By a little more than is allowed, and not by a little less."""
    for share, expected in ((0.98, False), (1.02, True)):
        watched = in_motion()
        told = moving(watched.slot - 1)
        name, most = ("wheel_angle", radians(0.1)) if wheels else ("p_WS_W", 1e-3)
        x, y, z = getattr(told, name)
        fault = watched.tick(**{name: (x, y + share * most, z)})
        assert ("off the command" in fault) is expected, fault


@pytest.mark.parametrize("name", ["wheel_angle", "p_WS_W"])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_position_that_is_no_number_is_off(name: str, axis: int) -> None:
    watched = in_motion()
    place = list(getattr(moving(watched.slot - 1), name))
    place[axis] = nan
    assert "off the command" in watched.tick(**{name: tuple(place)})


def test_between_two_commands_the_motion_is_known_to_microradians() -> None:
    watched = in_motion()
    time = (10 * watched.slot + 4) * MS
    true = swinging(0.01 * (watched.slot - 2) + 0.004)
    watched.words.new.append(
        replace(GOOD, number=99, time=time, wheel_angle=true.wheel_angle, p_WS_W=true.p_WS_W)
    )
    assert watched.monitor.watch(1e-9 * time, tracking=False) == ""
    assert 0.0 < watched.monitor.wheel_difference < 5e-6


def test_a_time_that_cannot_be_is_told() -> None:
    for time, text in ((-1, "stands still or runs back"), (10**12, "ms old, allowed: -20 to 50")):
        watched = in_motion()
        assert text in watched.tick(time=time, wheel_angle=(1e3, 0.0, 0.0))


def test_it_has_settled_when_the_drives_say_so() -> None:
    watched = in_motion()
    assert not watched.monitor.settled
    rest = replace(REST, wheel_angle=moving(50).wheel_angle, p_WS_W=moving(50).p_WS_W)
    for _ in range(2):
        watched.tick(rest)
        assert not watched.monitor.settled
    watched.tick(rest)
    assert watched.monitor.settled
    assert watched.tick(rest, state="latched") == ""


@pytest.mark.parametrize(
    ("said", "trouble"),
    [
        ({"limits": bytes(range(16))}, "the drives keep other limits (hash 00010203)"),
        ({"state": "stopping", "reason": "lost"}, "the drives stop by themselves: lost"),
        ({"margin": 0.0019}, "set points come 1.9 ms before they are due, allowed: at least 2 ms"),
    ],
)
def test_what_is_no_fault_keeps_it_at_rest_all_the_same(
    said: dict[str, object], trouble: str
) -> None:
    watched = Watched()
    watched.tick(REST)
    assert watched.monitor.trouble == ""
    assert watched.tick(REST, **said) == ""
    assert watched.monitor.trouble.startswith(trouble)


def test_a_short_margin_counts_for_a_quarter_of_a_second() -> None:
    watched = Watched()
    watched.tick(REST, margin=0.001)
    troubles = []
    for _ in range(40):
        watched.tick(REST, margin=inf)
        troubles.append(bool(watched.monitor.trouble))
    assert troubles == [True] * 25 + [False] * 15
    assert watched.monitor.least_margin == 0.001


def test_set_points_to_nobody_are_told_once_and_so_is_the_end_of_it() -> None:
    watched = Watched()
    for _ in range(100):
        assert watched.tick(REST, silent=True) == ""
        assert watched.monitor.notes() == []
    for _ in range(200):
        watched.tick(REST, silent=True)
    (note,) = watched.monitor.notes()
    assert note.startswith("set points go to nobody")
    assert watched.monitor.finding == note
    watched.tick(REST)
    assert watched.monitor.notes() == ["the drives are ready"]
    assert watched.monitor.finding == ""


def test_a_platform_that_follows_the_cue_counts_as_moving() -> None:
    watched = Watched()
    watched.tick(REST)
    assert "silent" in watched.monitor.watch(0.07, tracking=True)


def test_words_that_cannot_be_read_are_told_with_the_silence() -> None:
    watched = in_motion()
    watched.words.refusal = "status 7 has a quaternion of norm 2, allowed: 1"
    told = [watched.tick(silent=True) for _ in range(12)]
    assert told[-1].endswith(
        "allowed: 50 ms; refused: status 7 has a quaternion of norm 2, allowed: 1"
    )
