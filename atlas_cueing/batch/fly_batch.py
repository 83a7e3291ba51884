"""Many runs into one place, of which only what is missing is flown."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from .job import Job, RunLimits
from .job_result import KILLED, JobResult, kept
from .plan import PlannedRun
from .pool import Stop
from .store import ResultStore

# `fly_here`, or what `on_cluster` gives
Fly: TypeAlias = Callable[[Iterable[Job], Stop], Iterator[JobResult]]
Tell: TypeAlias = Callable[[JobResult], None]


@dataclass(frozen=True, slots=True)
class Outcome:
    """A planned run and what came of it; `record` is None when it was not flown any more."""

    run: PlannedRun
    record: JobResult | None


def missing(
    runs: Sequence[PlannedRun], results: ResultStore, *, retry: bool = False
) -> list[PlannedRun]:
    """Runs without a final record there, the longest first.

    With `retry` also those that had to be killed.
    """
    return _todo(runs, _done(runs, results, retry))


def _done(runs: Sequence[PlannedRun], results: ResultStore, retry: bool) -> dict[str, JobResult]:
    found = kept([run.id for run in runs], results)
    return {
        name: record for name, record in found.items() if not (retry and record.result in KILLED)
    }


def _todo(runs: Sequence[PlannedRun], done: Mapping[str, JobResult]) -> list[PlannedRun]:
    # A long one that begins last keeps everybody waiting.
    return sorted((run for run in runs if run.id not in done), key=lambda run: -run.ticks)


def fly_batch(
    runs: Sequence[PlannedRun],
    results: ResultStore,
    fly: Fly,
    limits: RunLimits,
    *,
    retry: bool = False,
    tell: Tell = lambda _: None,
    stop: Stop = lambda: False,
) -> list[Outcome]:
    """Fly what is missing in `results`, and give what came of every run, in the order of `runs`.

    A log and its record are each complete or not there, so a batch that is killed loses the runs
    under way and nothing else. `tell` is called with each record as it comes. Raises OutputError
    when the place cannot be used.
    """
    with results.opened():
        records = _done(runs, results, retry)
        for record in fly(
            (Job.of(run, results.place, limits) for run in _todo(runs, records)), stop
        ):
            records[record.id] = record
            tell(record)
        return [Outcome(run, records.get(run.id)) for run in runs]
