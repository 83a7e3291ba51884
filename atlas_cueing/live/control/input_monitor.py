"""From what is seen of the input to events: when it may be trusted, and when no longer."""

# mypyc: runs every tick

from ..input.source import SourceReading
from .state_machine import Event, State

STALE = 0.1  # s without a good sample
LOST = 1.0  # s; likewise
BAD_SAMPLES = 3  # refused one after the other
GOOD_TO_ENGAGE = 1.0  # s of good input before the platform moves at all
GOOD_TO_RESUME = 0.5  # s, likewise after a hold
ENGAGE_TIME = 4.0  # s of blending from park to the cue
RESUME_TIME = 1.0  # s, likewise after a hold

_FOLLOWING = (State.ENGAGING, State.RUNNING)


class InputMonitor:
    """Watches the input, a tick at a time."""

    def __init__(self) -> None:
        self._good_since: float | None = None
        self.held = False  # by the operator: only an engagement ends it

    def good_for(self, time: float) -> float:
        """How long the input has been good at `time`, s."""
        return 0.0 if self._good_since is None else time - self._good_since

    def watch(
        self, time: float, state: State, moving: bool, intake: SourceReading
    ) -> list[tuple[Event, str]]:
        """Events of this tick at `time` (s, real), each with its reason.

        moving: whether the platform follows the cue, or is not at rest yet.
        """
        trouble = _trouble(intake)
        if trouble:
            self._good_since = None
        elif self._good_since is None:
            self._good_since = time
        if state is State.HOLDING:
            return self._while_holding(time, moving, intake)
        if trouble and moving and state in _FOLLOWING:
            return [(Event.BAD, trouble)]
        return []

    def _while_holding(
        self, time: float, moving: bool, intake: SourceReading
    ) -> list[tuple[Event, str]]:
        if intake.age > LOST:
            return [(Event.LOST, f"no input for {intake.age:.2f} s")]
        if not self.held and not moving and self.good_for(time) >= GOOD_TO_RESUME:
            return [(Event.READY, "input is good again")]
        return []


def _trouble(intake: SourceReading) -> str:
    """What is wrong with the input, or nothing."""
    if intake.age > STALE:
        return f"no input for {intake.age:.2f} s" if intake.vehicle else "no input yet"
    if intake.bad_in_a_row >= BAD_SAMPLES:
        return f"{intake.bad_in_a_row} bad samples in a row: {intake.reason}"
    return f"the vehicle jumped: {intake.reason}" if intake.jumped else ""
