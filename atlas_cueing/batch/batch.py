"""Many runs into one folder, of which only what is missing is flown."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from .folder import locked
from .order import Limits, Order
from .plan import PlannedRun
from .record import KILLED, Record, kept
from .workers import Stop

Fly: TypeAlias = Callable[[Iterable[Order], Stop], Iterator[Record]]  # `fly_here` or `fly_on_cluster`
Tell: TypeAlias = Callable[[Record], None]


@dataclass(frozen=True, slots=True)
class Outcome:
    """A planned run and what came of it; `record` is None when it was not flown any more."""

    run: PlannedRun
    record: Record | None


def missing(runs: Sequence[PlannedRun], folder: Path, *, retry: bool = False) -> list[PlannedRun]:
    """Runs without a final record in the folder, the longest first; with `retry` also those that had to be killed."""
    todo = [run for run in runs if not _done(kept(run.id, folder), retry)]
    return sorted(todo, key=lambda run: -run.ticks)  # a long one that begins last keeps everybody waiting


def _done(record: Record | None, retry: bool) -> bool:
    return record is not None and not (retry and record.result in KILLED)


def fly_batch(
    runs: Sequence[PlannedRun],
    folder: Path,
    fly: Fly,
    limits: Limits,
    *,
    retry: bool = False,
    tell: Tell = lambda _: None,
    stop: Stop = lambda: False,
) -> list[Outcome]:
    """Fly what is missing in `folder`, and give what came of every run, in the order of `runs`.

    A log and its record are each complete or not there, so a batch that is killed loses the runs under way and nothing else.
    `tell` is called with each record as it comes. Raises OutputError when the folder cannot be used.
    """
    with locked(folder):
        flown = {}
        todo = missing(runs, folder, retry=retry)
        for record in fly((Order.of(run, str(folder.resolve()), limits) for run in todo), stop):
            flown[record.id] = record
            tell(record)
        unflown = {run.id for run in todo} - flown.keys()
        return [Outcome(run, flown.get(run.id) or (None if run.id in unflown else kept(run.id, folder))) for run in runs]
