"""What the drives tell of themselves."""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from ...rotation import Quat, Vec3

DRIVE_STATES = ("waiting", "following", "stopping", "latched")


@dataclass(frozen=True, slots=True)
class CabinSensors:
    """What tells the cabin's orientation, whatever the wheels do.

    turned: what the gyro has integrated, from the first status to the time of this one; it turns
        vectors of S now into those of S then.
    seen: when the newest fix was taken, ns of the loop's clock.
    fix_WS: orientation that was seen then; None without a fix up to now.
    """

    turned: Quat
    seen: int = 0
    fix_WS: Quat | None = None


@dataclass(frozen=True, slots=True)
class DriveStatus:
    """The drives at `time`.

    number: of the status, strictly increasing.
    state: waiting (for a first set point), following, stopping (their own stop, also when it has
        ended) or latched (until they are reset).
    reason: why they stop or are latched, or why they wait; empty otherwise.
    time: ns of the loop's clock.
    followed: session of the set points that they follow; 0 while waiting.
    newest: sequence of the newest set point taken.
    margin: least time from a set point's arrival until it was due, since the status before, s;
        infinite when none came.
    limits: hash of the limits that they keep.
    wheel_angle: of each wheel, rad.
    p_WS_W: position of the stage, m.
    good, refused: packets taken and not taken up to now.
    sensors: of the cabin, where there are any.
    """

    number: int
    state: str
    reason: str
    time: int
    followed: int
    newest: int
    margin: float
    limits: bytes
    wheel_angle: Vec3
    p_WS_W: Vec3
    good: int
    refused: int
    sensors: CabinSensors | None = None


class DriveFeedback(Protocol):
    """Where the drives' words come from."""

    @property
    def session(self) -> int:
        """Session of the set points that go to these drives."""

    @property
    def refusal(self) -> str:
        """Why the last status that came was not taken; empty when it was."""

    def statuses(self) -> Sequence[DriveStatus]:
        """Return what has come since the last call, in order, without waiting."""
