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
    """A planned run and its result; `result` is None when it was not flown any more."""

    run: PlannedRun
    result: JobResult | None


def missing(
    runs: Sequence[PlannedRun], store: ResultStore, *, retry: bool = False
) -> list[PlannedRun]:
    """Return the runs without a final result there, the longest first.

    With `retry` also those that had to be killed.
    """
    return _todo(runs, _done(runs, store, retry))


def _done(runs: Sequence[PlannedRun], store: ResultStore, retry: bool) -> dict[str, JobResult]:
    found = kept([run.id for run in runs], store)
    return {
        name: result for name, result in found.items() if not (retry and result.result in KILLED)
    }


def _todo(runs: Sequence[PlannedRun], done: Mapping[str, JobResult]) -> list[PlannedRun]:
    # the longest first: one that begins last would run alone at the end; one flight after the other
    place: dict[str, int] = {}
    for run in runs:
        place.setdefault(run.flight, len(place))
    left = [run for run in runs if run.id not in done]
    return sorted(left, key=lambda run: (-run.ticks, place[run.flight]))


def fly_batch(
    runs: Sequence[PlannedRun],
    store: ResultStore,
    fly: Fly,
    limits: RunLimits,
    *,
    retry: bool = False,
    tell: Tell = lambda _: None,
    stop: Stop = lambda: False,
) -> list[Outcome]:
    """Fly what is missing in `store`, and return the outcome of every run, in the order of `runs`.

    A log and its result are each complete or not there, so a batch that is killed loses the runs
    under way and nothing else. `tell` is called with each result as it comes. Raises OutputError
    when the place cannot be used.
    """
    with store.opened():
        done = _done(runs, store, retry)
        for result in fly((Job.of(run, store.place, limits) for run in _todo(runs, done)), stop):
            done[result.id] = result
            tell(result)
        return [Outcome(run, done.get(run.id)) for run in runs]
