"""Sweeps of short flights, and workers that come to harm on purpose."""

import sys
from pathlib import Path

import pytest

from atlas_cueing.batch import workers
from atlas_cueing.batch.order import Limits, Order
from atlas_cueing.batch.plan import PlannedRun, plan

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
LIMITS = Limits(time=60.0)

# A worker whose runs by `attitude` do something else first.
_SABOTEUR = """
import os, signal, sys, time
from pathlib import Path
from atlas_cueing.batch import alone, worker
fly = worker.fly_alone
def sabotaged(order):
    if "-attitude-" in order.id:
        {deed}
    return fly(order)
worker.fly_alone = sabotaged
worker.main()
"""


def planned(folder: Path, *overrides: str, text: str = SWEEP) -> list[PlannedRun]:
    """The runs of a sweep, written into `folder`."""
    (folder / "sweep.toml").write_text(text)
    return plan([folder / "sweep.toml"], overrides)


def order(run: PlannedRun, folder: Path, limits: Limits = LIMITS) -> Order:
    """To fly `run` into `folder`."""
    return Order.of(run, str(folder), limits)


def sabotage(monkeypatch: pytest.MonkeyPatch, deed: str) -> None:
    """Let every worker from here on do the deed in its runs by `attitude`."""
    monkeypatch.setattr(workers, "_COMMAND", (sys.executable, "-c", _SABOTEUR.format(deed=deed)))
