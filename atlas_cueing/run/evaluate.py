"""The figures of a run: while it is recorded, or from its log alone, to the last bit the same."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import LogError
from ..evaluation import (
    BLOCK_TICKS,
    Consistency,
    ContactLoads,
    LimitUse,
    Metrics,
    RunColumns,
    engaged_segment,
    load_violations,
    traction_lines,
    traction_lost,
    violations,
)
from ..recording import Log, read_log
from ..scenario.platform_file import Platform
from ..signals import TIMING, TOPICS

_ANY_LENGTH = 1 << 60  # bytes of messages: the run was ours
_NUMBERS = sum(len(topic.fields) for topic in TOPICS)  # of a tick


@dataclass(frozen=True, slots=True)
class Evaluation:
    """Metrics and limit use as `evaluation` names them, and one line for each violation.

    remarks: what is worth knowing and no violation, a line each.
    """

    metrics: dict[str, float] = field(default_factory=dict)
    limit_use: dict[str, float] = field(default_factory=dict)
    violations: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()


def evaluate_log(log: str | Path, platform: Platform) -> Evaluation:
    """Read the log and compute everything; a log that cannot be read back is itself a violation.

    Limits are looked at over the whole run, metrics of a live one over its longest stretch in state
    `running`.

    Example:
        >>> from atlas_cueing import evaluate_log, load_platform, load_scenario, run_scenario
        >>> scenario = load_scenario("scenarios/signal_sway.toml", ["duration_s=1"])
        >>> log = run_scenario(scenario, "sway.mcap").log
        >>> evaluate_log(log, load_platform("atlas-1.5m")).violations == ()  # would it bear it?
        True

    """
    found = _Found(platform)
    try:
        recorded = read_log(log, _ANY_LENGTH)
        found.add_log(recorded, RunColumns.of(recorded))
    except LogError as error:
        return Evaluation(violations=(f"not evaluated: {error}",))
    return found.evaluation()


def evaluate_flight(log: Log, flight: RunColumns, platform: Platform) -> Evaluation:
    """Compute everything of a log that has been read.

    The same figures, to the last bit, as the run gave that wrote it.

    flight: that of the log, with equally many rows everywhere.
    """
    found = _Found(platform)
    found.add_log(log, flight)
    return found.evaluation()


class Evaluator:
    """Evaluates a run that is not live while it is recorded, with memory for one block of it.

    It is an observer of `McapRecorder`.
    """

    def __init__(self, platform: Platform) -> None:
        """Begin the evaluation of a run on `platform`."""
        self._found = _Found(platform)
        self._begin()

    def add(self, ticks: NDArray[np.float64]) -> None:
        """Take in the ticks that follow, (n, fields of TOPICS and more)."""
        ticks = ticks[:, :_NUMBERS]
        while len(ticks):
            part, ticks = np.split(ticks, [BLOCK_TICKS - self._held])
            self._block[self._held : self._held + len(part)] = part
            self._held += len(part)
            if self._held == BLOCK_TICKS:
                self._take()

    def evaluation(self) -> Evaluation:
        """Evaluate all ticks, when there are no more."""
        self._take()
        return self._found.evaluation()

    def _begin(self) -> None:
        self._block = np.empty((BLOCK_TICKS, _NUMBERS), order="F")
        self._held = 0

    def _take(self) -> None:
        self._found.add(RunColumns.of(Log.of_ticks(self._block[: self._held])))
        self._begin()


class _Found:
    """What has been found in a run so far."""

    def __init__(self, platform: Platform) -> None:
        geometry = platform.geometry()
        self._use = LimitUse(platform.wheel_limit_values(), platform.stage_limit_values())
        self._metrics = Metrics()
        self._consistency = (
            Consistency(geometry.wheels_from_sphere, geometry.sphere_from_wheels)
            if geometry.slip_free
            else None
        )
        self._model = platform.load_model() if platform.has_loads else None
        self._loads = ContactLoads(self._model) if self._model else None

    def add(self, flight: RunColumns) -> None:
        """Take in the ticks that follow, all of them ridden."""
        for block in flight.blocks():
            self._metrics.add(block)
            self._check(block)

    def add_log(self, log: Log, flight: RunColumns) -> None:
        """Take in a whole run; a live one has metrics where it was running."""
        if TIMING.name not in log.tables:
            self.add(flight)
            return
        for block in engaged_segment(flight, log.statuses).blocks():
            self._metrics.add(block)
        for block in flight.blocks():
            self._check(block)

    def _check(self, block: RunColumns) -> None:
        self._use.add(block)
        if self._consistency:
            self._consistency.add(block)
        if self._loads:
            self._loads.add(block)

    def evaluation(self) -> Evaluation:
        """All figures, and the violations among them."""
        use = self._use.figures()
        trust = self._consistency.figures() if self._consistency else {}
        loads = self._loads.figures() if self._loads else {}
        found, remarks = violations(use), list[str]()
        if self._model:
            found += load_violations(loads, self._model)
            slips = loads["traction_slip_share"] > 0.0 and self._model.traction_finding
            lost = traction_lost(loads, self._model)
            (found if slips or lost else remarks).extend(traction_lines(loads, self._model))
        metrics = self._metrics.figures() | trust | loads
        return Evaluation(metrics, use, tuple(found), tuple(remarks))
