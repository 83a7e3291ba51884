"""Watches the input of a live run: when it may be trusted, and when no longer."""

# mypyc: runs every tick

from math import inf

from ..input.source import STALE as STALE
from ..input.source import SourceReading
from .state_machine import Event, State

LOST = 1.0  # s without a good sample, while holding
BAD_SAMPLES = 3  # refused one after the other
GOOD_TO_ENGAGE = 1.0  # s of good input before the platform moves at all
GOOD_TO_RESUME = 0.5  # s of good input before a hold ends
ENGAGE_TIME = 4.0  # s of blending from park to the cue
TOLD_AFTER = 1.5  # s of standing without good input before the reason is told
TOLD_AGAIN_AFTER = 2.0  # s at least between two reasons
RESUME_TIME = 1.0  # s of blending to the cue after a hold

_TRACKING = (State.ENGAGING, State.RUNNING)
_TOLD_IN = (State.ENGAGING, State.RUNNING, State.WAITING)


class InputMonitor:
    """Turns what the source reports into events of the state machine.

    It looks at the input only, never at the platform's motion or at the drives.

    held: the operator has asked to hold; the hold then ends by an engagement only, and no loss of
        the input ends it.
    """

    def __init__(self) -> None:
        self._good_since: float | None = None
        self._standing_since: float | None = None  # engaged, and waiting for good input
        self._last_told = -inf  # s
        self._told = self._noted = ""  # of samples that do not come, and that do
        self._last_held = -inf  # s; when the operator's hold was last seen
        self.held = False

    @property
    def good(self) -> bool:
        """Whether the input is good now."""
        return self._good_since is not None

    def good_for(self, time: float) -> float:
        """Return how long the input has been good at `time`, s."""
        return 0.0 if self._good_since is None else time - self._good_since

    def watch(
        self, time: float, state: State, moving: bool, reading: SourceReading
    ) -> list[tuple[Event, str]]:
        """Return the events of this tick, each with its reason.

        Args:
            time: of the loop's clock, s.
            state: the state the platform is in.
            moving: whether the platform follows the cue, or is not at rest yet.
            reading: what the source reports at `time`.
        """
        trouble = _trouble(reading)
        if trouble:
            self._good_since = None
        elif self._good_since is None:
            self._good_since = time
        standing = state is State.ENGAGING and not moving
        if not standing:
            self._standing_since = None
        elif self._standing_since is None:
            self._standing_since = time
        if state is State.WAITING:
            good = self.good_for(time) >= GOOD_TO_ENGAGE
            return [(Event.READY, "input is good")] if good else []
        if trouble and standing and time - (self._standing_since or time) >= TOLD_AFTER:
            absent = reading.age > reading.patience
            reason = reading.remark if absent and reading.remark else trouble
            self._last_told, self._told = time, reason
            return [(Event.ABSENT, reason)]
        if state is State.HOLDING:
            return self._events_while_holding(time, moving, reading)
        if trouble and moving and state in _TRACKING:
            return [(Event.BAD, trouble)]
        return []

    def remark(self, time: float, state: State, reading: SourceReading) -> str:
        """Return what is to be told of the input at `time` (s); empty when nothing is new.

        While waiting it is why no sample comes, but not more often than people read; else what is
        to be known of samples that come.
        """
        remark = reading.remark
        if reading.age <= reading.patience:
            if remark == self._noted or state not in _TOLD_IN:
                return ""
            self._noted = remark or self._noted
            return remark
        told = remark in ("", self._told) or time < self._last_told + TOLD_AGAIN_AFTER
        if told or state is not State.WAITING:
            return ""
        self._last_told, self._told = time, remark
        return remark

    def _events_while_holding(
        self, time: float, moving: bool, reading: SourceReading
    ) -> list[tuple[Event, str]]:
        if self.held:
            self._last_held = time
            return []
        if min(reading.age, time - self._last_held) > LOST:
            return [(Event.LOST, f"no input for {reading.age:.2f} s")]
        if not moving and self.good_for(time) >= GOOD_TO_RESUME:
            return [(Event.READY, "input is good again")]
        return []


def _trouble(reading: SourceReading) -> str:
    """Describe what is wrong with the input; empty when it is good."""
    if reading.age > reading.patience:
        return f"no input for {reading.age:.2f} s" if reading.vehicle else "no input yet"
    if reading.bad_in_a_row >= BAD_SAMPLES:
        return f"{reading.bad_in_a_row} bad samples in a row: {reading.reason}"
    return f"the vehicle jumped: {reading.reason}" if reading.jumped else ""
