"""Watches the input of a live run: when it may be trusted, and when no longer."""

# mypyc: runs every tick

from math import inf

from ..input.source import SourceReading
from .state_machine import Event, State

STALE = 0.1  # s without a good sample
LOST = 1.0  # s without a good sample, while holding
BAD_SAMPLES = 3  # refused one after the other
GOOD_TO_ENGAGE = 1.0  # s of good input before the platform moves at all
GOOD_TO_RESUME = 0.5  # s of good input before a hold ends
ENGAGE_TIME = 4.0  # s of blending from park to the cue
RESUME_TIME = 1.0  # s of blending to the cue after a hold

_TRACKING = (State.ENGAGING, State.RUNNING)


class InputMonitor:
    """Turns what the source reports into events of the state machine.

    It looks at the input only, never at the platform's motion or at the drives.

    held: the operator has asked to hold; the hold then ends by an engagement only, and no loss of
        the input ends it.
    """

    def __init__(self) -> None:
        self._good_since: float | None = None
        self._last_held = -inf  # s; when the operator's hold was last seen
        self.held = False

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
        if state is State.HOLDING:
            return self._events_while_holding(time, moving, reading)
        if trouble and moving and state in _TRACKING:
            return [(Event.BAD, trouble)]
        return []

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
    if reading.age > STALE:
        return f"no input for {reading.age:.2f} s" if reading.vehicle else "no input yet"
    if reading.bad_in_a_row >= BAD_SAMPLES:
        return f"{reading.bad_in_a_row} bad samples in a row: {reading.reason}"
    return f"the vehicle jumped: {reading.reason}" if reading.jumped else ""
