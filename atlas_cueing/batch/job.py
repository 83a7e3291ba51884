"""One run as a worker needs it, here or on another machine: nothing in it points to a file but the place of results."""

import json
from dataclasses import asdict, dataclass
from typing import Self

from .plan import PlannedRun

# s of wall time for one run; the longest of the bundled ones takes a tenth of it
DEFAULT_TIME_LIMIT = 1800.0
DEFAULT_MEMORY_LIMIT = 4.0  # GB of address space for one run; an ordinary one needs half of one
LEAST_MEMORY_LIMIT = 0.5  # GB; the interpreter with its libraries alone has 0.3


@dataclass(frozen=True, slots=True)
class RunLimits:
    """Of each run: `time` in s of wall time, `memory` in GB (10^9 bytes) of address space."""

    time: float = DEFAULT_TIME_LIMIT
    memory: float = DEFAULT_MEMORY_LIMIT


@dataclass(frozen=True, slots=True)
class Job:
    """A run to fly: its id, where results go, the files of the scenario by name, its limits, and trust in its script."""

    id: str
    place: str
    files: dict[str, str]  # bytes as Latin-1, which loses none
    limits: RunLimits
    trust_models: bool = False

    @classmethod
    def of(cls, run: PlannedRun, place: str, limits: RunLimits) -> Self:
        """The order for a planned run."""
        files = {name: data.decode("latin-1") for name, data in run.scenario.attachments().items()}
        return cls(run.id, place, files, limits, run.scenario.trust_models)

    def to_line(self) -> bytes:
        """One line of JSON."""
        return json.dumps(asdict(self)).encode() + b"\n"

    @classmethod
    def from_line(cls, line: bytes) -> Self:
        """The order again."""
        table = json.loads(line)
        return cls(
            table["id"],
            table["place"],
            table["files"],
            RunLimits(**table["limits"]),
            table["trust_models"],
        )
