"""What came of one run of a batch, and the file that keeps it."""

import json
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from math import isfinite, nan
from pathlib import Path
from typing import Any, Final, Self

from ..atomic_file import write_whole
from ..run import METHOD_FAILED, Evaluation, RunResult
from .store import ResultStore

# what `run` refuses with exit status 2, and could not be known before the vehicle was there
REFUSED: Final = "refused"
# The run itself ended so: the same again would end the same. Anything else (a full disk, a lost
# worker) is flown again.
FINAL = (
    "ok",
    "vehicle_failed",
    METHOD_FAILED,
    REFUSED,
    "failed",
    "crashed",
    "timed_out",
    "out_of_memory",
)
# a stronger machine or a longer limit may do better: `--retry`
_FIGURES = ("metrics", "limit_use")
KILLED = ("crashed", "timed_out", "out_of_memory")


@dataclass(frozen=True, slots=True)
class JobResult(RunResult):
    """The result of a run of a batch, as `<run id>.json` keeps it beside the log.

    Angles are in rad and everything else in SI, units in the names of the figures.

    id: of the run.
    result: as in `RunResult`, or refused (as a first pose that is not safe at rest), crashed,
        timed_out, out_of_memory, failed (an unexpected error); never kept: recording_failed,
        worker_lost, worker_differs.
    log: name of the file beside this one; mostly a `.part` when the run was killed.
    """

    id: str = field(kw_only=True)

    @property
    def final(self) -> bool:
        """Whether flying it again would change nothing."""
        return self.result in FINAL

    def to_json(self) -> dict[str, Any]:
        """Return everything by name; a figure that is not finite is None, as JSON has none."""
        # not super(): slots make a new class, which it does not find
        table = {"id": self.id, **RunResult.to_json(self)}
        return table | {name: _finite(getattr(self.evaluation, name)) for name in _FIGURES}

    @classmethod
    def from_json(cls, table: dict[str, Any]) -> Self:
        """Return the result that `to_json` gave.

        Raises KeyError, TypeError, ValueError or AttributeError for anything else.
        """
        metrics, use = ({k: _number(v) for k, v in table[name].items()} for name in _FIGURES)
        return cls(
            result=str(table["result"]),
            reason=str(table["reason"]),
            log=Path(table["log"]) if table["log"] else None,
            ticks=int(table["ticks"]),
            duration=float(table["duration_s"]),
            wall=float(table["wall_s"]),
            evaluation=Evaluation(metrics, use, tuple(table["violations"])),
            id=str(table["id"]),
        )


def _finite(figures: Mapping[str, float]) -> dict[str, float | None]:
    return {name: value if isfinite(value) else None for name, value in figures.items()}


def _number(value: Any) -> float:
    return nan if value is None else float(value)


def keep(result: JobResult, workdir: Path) -> None:
    """Write the result beside its log, complete or not at all."""
    write_whole(
        workdir / f"{result.id}.json", json.dumps(result.to_json(), indent=1, allow_nan=False)
    )


def kept(runs: Collection[str], store: ResultStore) -> dict[str, JobResult]:
    """Return the results, by run id, that are complete: with a sound file and their log."""
    there = store.names()
    read = store.read(name for name in (f"{run}.json" for run in runs) if name in there)
    found = {
        run: _sound(run, read[f"{run}.json"], there.__contains__)
        for run in runs
        if f"{run}.json" in read
    }
    return {run: result for run, result in found.items() if result}


def done_by_another(run: str, store: ResultStore) -> JobResult | None:
    """Read the result of a run that is kept, as `kept` finds it.

    Runs that had to be killed are left out: they are submitted only to be flown again.
    """
    content = store.read([f"{run}.json"]).get(f"{run}.json", b"")
    result = _sound(run, content, store.has)
    return result if result and result.result not in KILLED else None


def _sound(run: str, content: bytes, has: Callable[[str], bool]) -> JobResult | None:
    try:
        result = JobResult.from_json(json.loads(content))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return (
        result
        if result.id == run and result.final and (not result.log or has(str(result.log)))
        else None
    )
