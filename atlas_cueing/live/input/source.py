"""The source: where the vehicle comes from in real time."""

# mypyc: runs every tick

from dataclasses import dataclass
from typing import Final, Protocol

from ...rotation import IDENTITY, ZERO, Vec3
from ...signals import STANDARD_GRAVITY, VehicleState

STALE = 0.1  # s without a good sample that are borne, unless a source knows better

_REST_FORCE: Vec3 = (0.0, 0.0, -STANDARD_GRAVITY)


@dataclass(slots=True, init=False)
class SourceReading:
    """What a source reports at the time of a read.

    vehicle: state of the vehicle at that time, which is its `time`; None until a first good sample.
        The sign of its q_NB is arbitrary.
    age: s since the newest good sample; 0 for a source that cannot be late, infinite before the
        first sample.
    dropped: samples refused since the last read.
    bad_in_a_row: samples refused one after the other up to now.
    jumped: a sample came since the last read that does not follow from the one before, in attitude
        or in force.
    over: the flight is over, nothing will come any more.
    reason: why the last sample was dropped, or what jumped; empty otherwise.
    patience: age of the newest good sample that is borne, s; beyond it the input is no good.
    remark: what the user should know of the input, once: why no good sample comes, or that it is
        not as the scenario says; empty otherwise.
    """

    vehicle: Final[VehicleState | None]
    age: Final[float]
    dropped: Final[int]
    bad_in_a_row: Final[int]
    jumped: Final[bool]
    over: Final[bool]
    reason: Final[str]
    patience: Final[float]
    remark: Final[str]

    def __init__(
        self,
        vehicle: VehicleState | None,
        age: float,
        dropped: int,
        bad_in_a_row: int,
        jumped: bool,
        over: bool,
        reason: str,
        patience: float = STALE,
        remark: str = "",
    ) -> None:
        self.vehicle = vehicle
        self.age = age
        self.dropped = dropped
        self.bad_in_a_row = bad_in_a_row
        self.jumped = jumped
        self.over = over
        self.reason = reason
        self.patience = patience
        self.remark = remark


class Source(Protocol):
    """A vehicle whose state can be read at any time."""

    def read(self, time: float, advance: bool) -> SourceReading:
        """Return the state at `time`, without waiting and with a bounded amount of work.

        Args:
            time: s since the loop's start, monotonic, strictly increasing from call to call.
            advance: False lets the vehicle's own time stand still, as in a paused simulator; only
                sources that own their time obey.

        Raises VehicleError when a model that runs in this process fails.
        """

    def prepare(self, time: float) -> None:
        """Do now what a read at `time` (s) that advances would do first, if it can be done now.

        It changes no reading, and raises nothing: the read does.
        """

    def pin(self) -> None:
        """From now on take samples of the present sender only."""

    def release(self) -> None:
        """Take samples of any sender again."""

    def close(self) -> None:
        """Release what the source holds; nothing is read after it."""


def no_vehicle(time: float) -> VehicleState:
    """Return the state that stands in the log before the first sample: level and at rest."""
    return VehicleState(time, IDENTITY, ZERO, _REST_FORCE)
