"""Clocks: processor time beside wall time, medians of interleaved rounds, fresh processes.

A host that gives the processor to others makes wall time grow and processor time hardly, so ratios
are of processor time. What is compared is measured in turns, so that a slow spell meets all of it.
"""

import gc
import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter, perf_counter_ns, process_time
from typing import Any, Self

COMMAND = (sys.executable, "-m", "atlas_cueing")


@dataclass(frozen=True, slots=True)
class Cost:
    """Processor time of all threads and wall time, s."""

    cpu: float
    wall: float

    def __sub__(self, other: Self) -> "Cost":
        return Cost(self.cpu - other.cpu, self.wall - other.wall)

    def __mul__(self, count: float) -> "Cost":
        return Cost(self.cpu * count, self.wall * count)

    def __truediv__(self, count: float) -> "Cost":
        return Cost(self.cpu / count, self.wall / count)


def cost(work: Callable[[], object]) -> Cost:
    """Of one call, after the garbage of what was before is gone."""
    gc.collect()
    wall, cpu = perf_counter(), process_time()
    work()
    return Cost(process_time() - cpu, perf_counter() - wall)


def interleaved(
    rounds: int, works: Mapping[Any, Callable[[], Cost]], *, warm: bool = False
) -> dict[Any, list[Cost]]:
    """Costs of each work, in rounds of all of them.

    `warm` adds a round before them that does not count.
    """
    found: dict[Any, list[Cost]] = {name: [] for name in works}
    for number in range(rounds + warm):
        for name, work in works.items():
            spent = work()
            if number >= warm:
                found[name].append(spent)
    return found


@contextmanager
def without_garbage() -> Iterator[None]:
    """No collection of garbage meanwhile.

    What a benchmark keeps would make it dearer than it is in a run.
    """
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
        gc.unfreeze()


def each(call: Callable[[Any], object], items: Sequence[Any]) -> list[int]:
    """Wall time of each call, ns; the clock's own cost (see `clock_cost`) is in it."""
    times = []
    for item in items:
        begun = perf_counter_ns()
        call(item)
        times.append(perf_counter_ns() - begun)
    return times


def clock_cost(calls: int = 20000) -> float:
    """What a pair of clock calls and an empty function add to each time of `each`, us."""
    return median(each(lambda _: None, range(calls))) / 1e3


def fresh(arguments: Sequence[str | Path], folder: Path, command: Sequence[str] = COMMAND) -> Cost:
    """A process of its own, by default of atlas-cueing, from its start to its end.

    Quits when it fails.

    It keeps what it has compiled in `folder`, also where the environment forbids it: as an
    installed program, it does not compile its source at every start. So the first process of a kind
    is a slow one.
    """
    environment = {
        name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"
    }
    environment["PYTHONPYCACHEPREFIX"] = str(folder / "compiled")
    with (folder / "said").open("w+") as said:
        begun = perf_counter()
        process = subprocess.Popen(
            [*command, *map(str, arguments)], cwd=folder, env=environment, stdout=said, stderr=said
        )
        _, status, usage = os.wait4(process.pid, 0)
        wall = perf_counter() - begun
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            said.seek(0)
            sys.exit(
                f"{' '.join(map(str, arguments))}: exit status {process.returncode}\n{said.read()}"
            )
    return Cost(usage.ru_utime + usage.ru_stime, wall)
