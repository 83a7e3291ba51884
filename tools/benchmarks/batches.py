"""What a second process is worth to a batch."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from statistics import median

from .effort import Bench
from .flights import sweep_file
from .rows import Asked, Row
from .timing import Cost, fresh, interleaved

ASKED = Asked(1.8, at_least=True, of_ratio=True)


def measure(bench: Bench) -> Iterator[Row]:
    """Runs a minute with two jobs over those with one.

    The whole command, start-up and table too.
    """
    effort = bench.effort
    bench.say(
        f"batch: {effort.batch_runs} runs of {effort.batch_flight:g} s, 1 and 2 jobs,"
        f" {effort.batch_rounds} rounds"
    )
    sweep = sweep_file(bench.folder, effort.batch_runs, effort.batch_flight)
    number = iter(range(1000))
    works = {jobs: partial(_fly, bench.folder, sweep, jobs, number) for jobs in (1, 2)}
    found = interleaved(effort.batch_rounds, works, warm=True)
    one, two = ([60.0 * effort.batch_runs / cost.wall for cost in found[jobs]] for jobs in (1, 2))
    cpu = " and ".join(f"{median(cost.cpu for cost in found[jobs]):.1f}" for jobs in (1, 2))
    note = f"{effort.batch_runs} runs of {effort.batch_flight:g} s; CPU {cpu} s"
    yield Row(
        "batch",
        "batch, 2 jobs, by wall time",
        median(two),
        "runs/min",
        two,
        "1 job",
        median(one),
        ASKED,
        note,
    )


def _fly(folder: Path, sweep: Path, jobs: int, number: Iterator[int]) -> Cost:
    return fresh(["batch", sweep, "-o", f"batch_{next(number)}", "--jobs", str(jobs)], folder)
