"""What is requested of a live run from outside."""

# mypyc: runs every tick

from collections.abc import Callable, Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class OperatorInputs:
    """What is requested, and by whom.

    buttons: returns the buttons pressed since the last call: engage, hold, park, reset, stop.
    stop_requests: returns how often the process has been asked to end; the first request parks, the
        second stops at once.
    duration: s until the platform parks by itself.
    attended: an operator can engage and reset; otherwise the run engages by itself and is over when
        it has parked or stopped.
    losses: returns the helpers found dead since the last call: what to tell, and whether to park.
    carries: there are drives, which an unattended run does not leave (`homecoming`).
    """

    buttons: Callable[[], Iterable[str]] = tuple
    stop_requests: Callable[[], int] = int
    duration: float = float("inf")
    attended: bool = False
    losses: Callable[[], Iterable[tuple[str, bool]]] = tuple
    carries: bool = False
