"""Where the vehicle comes from in real time."""

# mypyc: runs every tick

from dataclasses import dataclass
from typing import Protocol

from ...signals import VehicleState


@dataclass(frozen=True, slots=True)
class SourceReading:
    """What a source knows at the asked time.

    vehicle: the vehicle at the asked time, which is its `time`; None until a first good sample.
    age: s since the newest good sample; 0 for a source that cannot be late, infinite before the
        first sample.
    dropped: samples refused since the last read.
    bad_in_a_row: samples refused one after the other up to now.
    jumped: a sample came since the last read that does not follow from the one before, in attitude
        or in force.
    over: the flight is over, nothing will come any more.
    reason: why the last sample was dropped, or what jumped; empty otherwise.
    """

    vehicle: VehicleState | None
    age: float
    dropped: int
    bad_in_a_row: int
    jumped: bool
    over: bool
    reason: str


class Source(Protocol):
    """A vehicle that can be asked for at any time."""

    def read(self, time: float, advance: bool) -> SourceReading:
        """The state at `time` (s since the loop's start, monotonic, strictly increasing from call to call).

        advance: False lets the vehicle's own time stand still, as in a paused simulator; only
        sources that own their time obey. Never waits, and does a bounded amount of work. Raises
        VehicleError when a model of our own fails.
        """

    def pin(self) -> None:
        """From now on listen to the present sender only."""

    def close(self) -> None:
        """Let go of what the source holds; nothing is read after it."""
