"""One run as a worker needs it, here or on another machine.

Nothing in it points to a file but the place of results, and files too large to carry along, which
have to be there under the same path.
"""

import json
from dataclasses import asdict, dataclass, field
from typing import Self

from .plan import PlannedRun

# s of wall time for one run; the longest of the bundled ones takes a tenth of it
DEFAULT_TIME_LIMIT = 1800.0
DEFAULT_MEMORY_LIMIT = 4.0  # GB of address space for one run; an ordinary one needs half of one
LEAST_MEMORY_LIMIT = 0.5  # GB; the interpreter with its libraries alone has 0.3


@dataclass(frozen=True, slots=True)
class RunLimits:
    """Limits of each run: wall `time` in s, and address space `memory` in GB (10^9 bytes)."""

    time: float = DEFAULT_TIME_LIMIT
    memory: float = DEFAULT_MEMORY_LIMIT


@dataclass(frozen=True, slots=True)
class Job:
    """A run to fly.

    id: of the run. place: where results go.
    files: the files of the scenario by name, bytes as Latin-1, which loses none.
    flight: the same for runs in which the vehicle does the same, which then flies once; "" for
        one that is flown by itself.
    trust_models: whether the user trusts its script or aircraft.
    large: absolute paths of files that are not carried along, by name. The run's id holds their
        content, so a worker that finds another one there does not fly.
    """

    id: str
    place: str
    files: dict[str, str]
    limits: RunLimits
    trust_models: bool = False
    large: dict[str, str] = field(default_factory=dict)
    flight: str = ""

    @classmethod
    def of(cls, run: PlannedRun, place: str, limits: RunLimits) -> Self:
        """Return the job of a planned run, whose results go to `place`."""
        files = {name: data.decode("latin-1") for name, data in run.scenario.attachments().items()}
        large = {
            name: str(path.resolve())
            for name, path in run.scenario.live_flight.large_files().items()
        }
        return cls(run.id, place, files, limits, run.scenario.trust_models, large, run.flight)

    def to_line(self) -> bytes:
        """Return the job as one line of JSON."""
        return json.dumps(asdict(self)).encode() + b"\n"

    @classmethod
    def from_line(cls, line: bytes) -> Self:
        """Return the job that `to_line` gave."""
        table = json.loads(line)
        return cls(
            table["id"],
            table["place"],
            table["files"],
            RunLimits(**table["limits"]),
            table["trust_models"],
            table["large"],
            table["flight"],
        )
