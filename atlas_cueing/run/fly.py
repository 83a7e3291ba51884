"""One scenario, from the vehicle to a finished and evaluated log."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import TypeAlias

from ..errors import MethodError, OutputError, VehicleError
from ..pipeline import Pipeline
from ..scenario import Scenario
from ..signals import Vehicle
from .build import prepare
from .evaluate import Evaluator
from .open_recorder import open_recorder
from .open_vehicle import open_vehicle
from .result import METHOD_FAILED, RunResult
from .run_log import Progress, RunLog
from .stop_request import StopRequest
from .ticks import ticks

Open: TypeAlias = Callable[[Scenario], Vehicle]  # what `open_vehicle` does, or in its place


@dataclass(frozen=True, slots=True)
class _Outcome:
    """How a flight ended: a result of `RunResult`, and why it is not ok."""

    result: str = "ok"
    reason: str = ""


def run_scenario(
    scenario: Scenario,
    log: str | Path,
    *,
    progress: Progress | None = None,
    opened: Open | None = None,
) -> RunResult:
    """Fly `scenario` and write `log`, which is replaced if it exists.

    The log is finished whatever ends the flight. Raises InputError (nothing was written) when the
    scenario cannot fly or the log cannot be opened; an unexpected error is raised again after the
    log is finished.

    progress: called now and then with the flight time, s.
    opened: gives the vehicle; by default the one that the scenario asks for.

    Example:
        >>> from atlas_cueing import load_scenario, run_scenario
        >>> scenario = load_scenario("scenarios/f16_rolls.toml", ["duration_s=1"])
        >>> result = run_scenario(scenario, "rolls.mcap")
        >>> result.result, result.ticks, result.evaluation.violations
        ('ok', 121, ())
        >>> result.evaluation.metrics["rate_rms_rad_s"] < 0.1
        True

    """
    begun, log = perf_counter(), Path(log)
    flight = _prepared(scenario, opened or open_vehicle)
    evaluator = Evaluator(scenario.platform)
    recorder = open_recorder(scenario, log, observer=evaluator.add)
    sink = RunLog(recorder, progress or (lambda _: None))
    try:
        outcome = _record(flight, sink)
    except OutputError as error:
        recorder.abandon()
        failed = "recording_failed", str(error), recorder.part
        return RunResult(*failed, sink.ticks, sink.time, perf_counter() - begun)
    wall = perf_counter() - begun
    ended = outcome.result, outcome.reason, log
    return RunResult(*ended, sink.ticks, sink.time, wall, evaluator.evaluation())


_Ready: TypeAlias = tuple[Vehicle, Pipeline]


def _prepared(scenario: Scenario, opened: Open) -> _Ready | _Outcome:
    """Open the vehicle, and build the pipeline for it; a failing first state is an outcome."""
    try:
        vehicle = opened(scenario)
    except VehicleError as error:
        return _Outcome("vehicle_failed", str(error))
    return prepare(scenario, vehicle)


def _record(flight: _Ready | _Outcome, sink: RunLog) -> _Outcome:
    """Fly, and finish the log whatever happens. Raises OutputError, and what is unexpected."""
    sink.status("running", "")
    try:
        outcome = flight if isinstance(flight, _Outcome) else _fly(*flight, sink)
    except OutputError:
        raise
    except BaseException as error:
        sink.finish("failed", f"{type(error).__name__}: {error}")
        raise
    sink.finish(outcome.result, outcome.reason)
    return outcome


def _fly(vehicle: Vehicle, pipeline: Pipeline, sink: RunLog) -> _Outcome:
    """Fly into the log, and return how that ended."""
    try:
        with StopRequest() as stop:
            for block in ticks(vehicle, pipeline, lambda: stop.requested):
                sink.add(block)
        interrupted = stop.requested
    except VehicleError as error:
        return _Outcome("vehicle_failed", str(error))
    except MethodError as error:
        return _Outcome(METHOD_FAILED, str(error))
    except KeyboardInterrupt:
        interrupted = True
    if interrupted:
        return _Outcome("interrupted", f"asked to stop at {sink.time:.3f} s")
    return _Outcome()
