"""Sweeps of short flights, and workers that come to harm on purpose."""

import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pytest

from atlas_cueing.batch import pool as workers
from atlas_cueing.batch.execute import fly_alone
from atlas_cueing.batch.job import Job, RunLimits
from atlas_cueing.batch.job_result import JobResult, keep, kept
from atlas_cueing.batch.plan import PlannedRun, plan
from atlas_cueing.batch.store import open_store

SWEEP = """
name = "short"
duration_s = 0.25
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
[sweep]
cueing.method = ["blend", "attitude", "force", "classical"]
"""
LIMITS = RunLimits(time=600.0)

# A worker whose runs by `attitude` do something else first.
_SABOTEUR = """
import os, signal, sys, time
from pathlib import Path
from atlas_cueing.batch import execute as alone
from atlas_cueing.batch import worker_main as worker
fly = worker.fly_alone
def sabotaged(job, workdir, flight):
    if "-attitude-" in job.id:
        {deed}
    return fly(job, workdir, flight)
worker.fly_alone = sabotaged
worker.main()
"""


def planned(folder: Path, *overrides: str, text: str = SWEEP) -> list[PlannedRun]:
    """The runs of a sweep, written into `folder`."""
    (folder / "sweep.toml").write_text(text)
    return plan([folder / "sweep.toml"], overrides)


def job_of(run: PlannedRun, place: Path | str, limits: RunLimits = LIMITS) -> Job:
    """To fly `run` into a folder or to a URL."""
    return Job.of(run, str(place), limits)


def fly_in_line(jobs: Iterable[Job], stop: Callable[[], bool]) -> Iterator[JobResult]:
    """The seam's plainest double: into folders, in this process, one after the other."""
    for job in jobs:
        if stop():
            return
        result = fly_alone(job, Path(job.place))
        keep(result, Path(job.place))
        yield result


def kept_in(place: Path | str, run: str) -> JobResult | None:
    """The result that a batch would find there."""
    return kept([run], open_store(str(place))).get(run)


def sabotage(monkeypatch: pytest.MonkeyPatch, deed: str) -> None:
    """Let every worker from here on do the deed in its runs by `attitude`."""
    monkeypatch.setattr(workers, "_COMMAND", (sys.executable, "-c", _SABOTEUR.format(deed=deed)))
