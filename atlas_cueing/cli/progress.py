"""How far a run is, on stderr, when someone is looking."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter

from ..printable import printable
from .streams import terminal_of

_SHORT = 1.0  # s; a run that is over by then shows nothing


@contextmanager
def shown_progress(name: str, duration: float | None) -> Iterator[Callable[[float], None] | None]:
    """A function to call with the flight time (s), or None when stderr is no terminal.

    `duration` is that of the flight in s, None when only the vehicle knows its end.
    """
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    name_column, flown_column = (
        TextColumn("{task.description}", markup=False),
        TextColumn("{task.fields[flown]}"),
    )
    columns = [name_column, BarColumn(), flown_column, TimeRemainingColumn()]
    begun = perf_counter()
    with Progress(*columns, console=Console(file=terminal_of(sys.stderr)), transient=True) as bar:
        task = bar.add_task(printable(name), total=duration, flown="", visible=False)

        def progress(time: float) -> None:
            """Move the bar to the flight time, s."""
            wall = perf_counter() - begun
            flown = f"{time:.0f} s flown, {time / wall:.1f} times real time"
            bar.update(task, completed=time, flown=flown, visible=wall > _SHORT)

        yield progress


@contextmanager
def shown_share(name: str) -> Iterator[Callable[[float], None]]:
    """Give a function to call with the share that is done, 0 to 1; it shows a bar on a terminal."""
    if not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn

    columns = [TextColumn("{task.description}", markup=False), BarColumn(), TaskProgressColumn()]
    begun = perf_counter()
    with Progress(*columns, console=Console(file=terminal_of(sys.stderr)), transient=True) as bar:
        task = bar.add_task(printable(name), total=1.0, visible=False)

        def progress(share: float) -> None:
            """Move the bar to the share that is done."""
            bar.update(task, completed=share, visible=perf_counter() - begun > _SHORT)

        yield progress
