"""One scenario, from the vehicle to a finished and evaluated log."""

from collections.abc import Callable
from dataclasses import dataclass
from math import degrees, radians
from pathlib import Path
from time import perf_counter
from typing import Final, TypeAlias

from ..errors import MethodError, OutputError, VehicleError
from ..pipeline import Pipeline
from ..scenario import Scenario
from ..signals import Sink, Tick, Vehicle, VehicleState, attitude_jump
from .build import prepare
from .evaluate import Evaluator
from .open_recorder import open_recorder
from .open_vehicle import open_vehicle
from .result import METHOD_FAILED, RunResult
from .stop_request import StopRequest
from .ticks import ticks

Progress: TypeAlias = Callable[[float], None]  # called now and then with the flight time, s
Open: TypeAlias = Callable[[Scenario], Vehicle]  # what `open_vehicle` does, or in its place

# Attitude and body rates of one step agree to dt^2/2 times the angular acceleration: 0.04 deg at
# 120 Hz and 20 rad/s^2. From here on (assumed) a difference is noted in /status as a jump; at 10 Hz
# a hard manoeuvre may pass for one.
JUMP: Final = radians(0.5)


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
    sink = _RunLog(recorder, progress or (lambda _: None))
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


def _record(flight: _Ready | _Outcome, sink: "_RunLog") -> _Outcome:
    """Fly, and finish the log whatever happens. Raises OutputError, and what is unexpected."""
    sink.status("running", "")
    try:
        outcome = flight if isinstance(flight, _Outcome) else _fly(*flight, sink)
    except OutputError:
        raise
    except BaseException as error:
        sink.finish(_Outcome("failed", f"{type(error).__name__}: {error}"))
        raise
    sink.finish(outcome)
    return outcome


def _fly(vehicle: Vehicle, pipeline: Pipeline, sink: "_RunLog") -> _Outcome:
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


class _RunLog:
    """The log of a run, with its jumps of attitude noted.

    ticks: number of ticks recorded. time: of the last one, s.
    """

    def __init__(self, sink: Sink, progress: Progress) -> None:
        self.ticks, self.time = 0, 0.0
        self._sink = sink
        self._progress = progress
        self._before: VehicleState | None = None
        self._jumping = False

    def add(self, block: list[Tick]) -> None:
        """Record a block of ticks."""
        for tick in block:
            self._sink.append(tick)
            self.ticks += 1
            self.time = tick.vehicle.time
            self._note_jump(tick.vehicle)
        self._progress(self.time)

    def status(self, state: str, reason: str) -> None:
        """Record a change of state at the last tick."""
        self._sink.status(self.time, state, reason)

    def finish(self, outcome: _Outcome) -> None:
        """Finish the log with the outcome."""
        self.status("done" if outcome.result == "ok" else outcome.result, outcome.reason)
        self._sink.close(outcome.result, outcome.reason)

    def _note_jump(self, now: VehicleState) -> None:
        jump = attitude_jump(self._before, now) if self._before else 0.0
        self._before = now
        if (jump >= JUMP) != self._jumping:
            self._jumping = not self._jumping
            reason = (
                f"attitude jumped by {degrees(jump):.3g} deg that the body rates do not explain"
            )
            state = ("attitude_jump", reason) if self._jumping else ("running", "")
            self.status(*state)
