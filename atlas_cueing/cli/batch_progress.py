"""How far a batch is, on stderr: a bar for people, a line now and then for files."""

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from time import perf_counter
from typing import TYPE_CHECKING

from .streams import terminal_of
from .text import say

if TYPE_CHECKING:
    from ..batch import JobResult, PlannedRun

_LINE_EVERY = 15.0  # s between two plain lines


class Count:
    """Runs done and failed, how fast, and how long it may take yet."""

    def __init__(self, runs: "Sequence[PlannedRun]") -> None:
        self.total = len(runs)
        self.done = self.failed = 0
        self._flown = 0.0
        self._ticks = {run.id: run.duration / run.step if run.duration else 0.0 for run in runs}
        self._left = sum(self._ticks.values())
        # ticks that were flown: many a run ends, or fails, long before its planned end
        self._worked = 0
        self._begun = perf_counter()

    def add(self, result: "JobResult") -> None:
        """One more run."""
        self.done += 1
        self.failed += not result.clean
        self._flown += result.duration
        self._worked += result.ticks
        self._left -= self._ticks.get(result.id, 0.0)

    @property
    def wall(self) -> float:
        """Since the start, s."""
        return perf_counter() - self._begun

    def text(self) -> str:
        """Everything in one line."""
        speed = self._flown / max(self.wall, 1e-9)
        runs = "1 run" if self.total == 1 else f"{self.total} runs"
        return (
            f"{self.done} of {runs} done, {self.failed} failed, {speed:.0f} flight s a"
            f" second{self._rest()}"
        )

    def _rest(self) -> str:
        if self._worked == 0 or self.done == self.total:
            return ""
        return f", {spoken(self.wall * self._left / self._worked)} left at most"


def spoken(time: float) -> str:
    """A time (s) in the unit that fits."""
    if time < 100.0:
        return f"{time:.0f} s"
    return f"{time / 60.0:.0f} min" if time < 6000.0 else f"{time / 3600.0:.1f} h"


@contextmanager
def batch_progress(runs: "Sequence[PlannedRun]") -> "Iterator[Callable[[JobResult], None]]":
    """Yield a function to call with each result as it comes."""
    count = Count(runs)
    show = _bar if sys.stderr.isatty() else _lines
    with show(count) as update:

        def tell(result: "JobResult") -> None:
            """Count one more run, and show it."""
            count.add(result)
            update()

        yield tell


@contextmanager
def _lines(count: Count) -> Iterator[Callable[[], None]]:
    last = 0.0

    def update() -> None:
        """A line when it is time for one, and at the end."""
        nonlocal last
        if count.wall - last >= _LINE_EVERY or count.done == count.total:
            last = count.wall
            say(count.text())

    yield update


@contextmanager
def _bar(count: Count) -> Iterator[Callable[[], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    console = Console(file=terminal_of(sys.stderr))
    with Progress(BarColumn(), TextColumn("{task.description}"), console=console) as bar:
        task = bar.add_task(count.text(), total=count.total)
        yield lambda: bar.update(task, completed=count.done, description=count.text())
