"""What came of one run of a batch, and the file that keeps it."""

import json
from collections.abc import Callable, Collection
from dataclasses import asdict, dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any, Self

from ..atomic_file import write_whole
from .store import ResultStore

# The run itself ended so: the same again would end the same. Anything else (a full disk, a lost
# worker) is flown again.
FINAL = ("ok", "vehicle_failed", "failed", "crashed", "timed_out", "out_of_memory")
# a stronger machine or a longer limit may do better: `--retry`
KILLED = ("crashed", "timed_out", "out_of_memory")


@dataclass(frozen=True, slots=True)
class JobResult:
    """The `<run id>.json` beside a log, angles in rad and everything else in SI, units in the names of the figures.

    result: ok, vehicle_failed (did not load, or went wild), failed (an error nobody expected),
        crashed, timed_out, out_of_memory; never kept: recording_failed, worker_lost,
        worker_differs.
    log: file name beside the record; mostly a `.part` when the run was killed, empty when there is
        none.
    duration, wall: of the flight and of flying it, s.
    """

    id: str
    result: str
    reason: str = ""
    log: str = ""
    ticks: int = 0
    duration: float = 0.0
    wall: float = 0.0
    violations: tuple[str, ...] = ()
    metrics: dict[str, float] = field(default_factory=dict)
    limit_use: dict[str, float] = field(default_factory=dict)

    @property
    def clean(self) -> bool:
        """Nothing failed and every limit was kept."""
        return self.result == "ok" and not self.violations

    @property
    def final(self) -> bool:
        """Flying it again would change nothing."""
        return self.result in FINAL

    def to_json(self) -> dict[str, Any]:
        """By name, unit in the name; a figure that is not finite is None, as JSON has no other word for it."""
        table = asdict(self)
        table["duration_s"], table["wall_s"] = table.pop("duration"), table.pop("wall")
        for name in ("metrics", "limit_use"):
            table[name] = {
                key: value if isfinite(value) else None for key, value in table[name].items()
            }
        return table

    @classmethod
    def from_json(cls, table: dict[str, Any]) -> Self:
        """The record again.

        Raises KeyError, TypeError, ValueError or AttributeError for anything else.
        """
        given = dict(table)
        duration, wall = float(given.pop("duration_s")), float(given.pop("wall_s"))
        for name in ("metrics", "limit_use"):
            given[name] = {
                key: float("nan") if value is None else float(value)
                for key, value in given[name].items()
            }
        given["violations"] = tuple(given["violations"])
        return cls(**given, duration=duration, wall=wall)


def keep(record: JobResult, workdir: Path) -> None:
    """Write the record beside its log, complete or not at all."""
    write_whole(
        workdir / f"{record.id}.json", json.dumps(record.to_json(), indent=1, allow_nan=False)
    )


def kept(runs: Collection[str], results: ResultStore) -> dict[str, JobResult]:
    """Records by id of those runs that need no flying again.

    Whose record is there and sound, and whose log is there.
    """
    there = results.names()
    read = results.read(name for name in (f"{run}.json" for run in runs) if name in there)
    records = {
        run: _sound(run, read[f"{run}.json"], there.__contains__)
        for run in runs
        if f"{run}.json" in read
    }
    return {run: record for run, record in records.items() if record}


def done_by_another(run: str, results: ResultStore) -> JobResult | None:
    """The record of a run as `kept` finds it, without those that had to be killed: whoever orders them wants them again."""
    content = results.read([f"{run}.json"]).get(f"{run}.json", b"")
    record = _sound(run, content, results.has)
    return record if record and record.result not in KILLED else None


def _sound(run: str, content: bytes, has: Callable[[str], bool]) -> JobResult | None:
    try:
        record = JobResult.from_json(json.loads(content))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return (
        record
        if record.id == run and record.final and (not record.log or has(record.log))
        else None
    )
