"""One scenario, from the vehicle to a finished and evaluated log."""

from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from math import degrees, radians
from pathlib import Path
from time import perf_counter
from typing import Final, TypeAlias

from ..errors import OutputError, VehicleError
from ..pipeline import Pipeline
from ..recording import McapRecorder
from ..scenario import Scenario
from ..signals import Sink, Vehicle, VehicleState, attitude_jump
from ..vehicles import JsbsimVehicle, SignalFlight, SignalVehicle
from .build import prepare
from .evaluate import Evaluator
from .result import RunResult
from .stop_request import StopRequest

Progress: TypeAlias = Callable[[float], None]  # called now and then with the flight time, s

# Attitude and body rates of one step agree to dt^2/2 times the angular acceleration: 0.04 deg at
# 120 Hz and 20 rad/s^2. From here on (assumed) a difference is noted in /status as a jump; at 10 Hz
# a hard manoeuvre may pass for one.
JUMP: Final = radians(0.5)
# ticks taken through the pipeline stage by stage; also from one call of Progress to the next
BLOCK: Final = 256


@dataclass(slots=True)
class Flown:
    """How a flight ended: `ticks` recorded and the `time` of the last one (s)."""

    ticks: int = 0
    time: float = 0.0
    result: str = "ok"
    reason: str = ""


def run_scenario(
    scenario: Scenario, log: str | Path, *, progress: Progress | None = None
) -> RunResult:
    """Fly `scenario` and write `log`, which is replaced if it exists.

    The log is finished whatever ends the flight. Raises InputError (nothing was written) when the
    scenario cannot fly or the log cannot be opened; an error that nobody expected is raised again
    after the log is finished.
    """
    begun, log = perf_counter(), Path(log)
    flown = Flown()
    loaded = _load(scenario, flown)
    vehicle, pipeline = prepare(scenario, loaded) if loaded else (None, None)
    evaluator = Evaluator(scenario.platform)
    recorder = McapRecorder(
        log,
        head_S=scenario.platform.head_S,
        metadata=_metadata(scenario),
        attachments=scenario.attachments(),
        chunk_ticks=scenario.file.recording.chunk_ticks,
        skip_topics=scenario.file.recording.skip,
        observer=evaluator.add,
    )
    try:
        _record(vehicle, pipeline, recorder, flown, progress)
    except OutputError as error:
        recorder.abandon()
        wall = perf_counter() - begun
        return RunResult(
            "recording_failed", str(error), recorder.part, flown.ticks, flown.time, wall
        )
    wall = perf_counter() - begun
    return RunResult(
        flown.result, flown.reason, log, flown.ticks, flown.time, wall, evaluator.evaluation()
    )


def fly(
    vehicle: Vehicle,
    pipeline: Pipeline,
    sink: Sink,
    flown: Flown,
    progress: Progress | None,
    stop: StopRequest,
) -> None:
    """Step until the vehicle ends or `stop` is requested; `flown` is kept up to date.

    Raises what the vehicle raises.
    """
    kept = _Keeper(pipeline, sink, flown, progress)
    states, more = [vehicle.state], True
    while more:
        try:
            more = _gather(vehicle, states, stop)
        finally:  # what was flown is kept, also when the vehicle fails
            kept.keep(states)
        states = []


def _gather(vehicle: Vehicle, states: list[VehicleState], stop: StopRequest) -> bool:
    """Fill up a block of states; False at the end of the flight."""
    while len(states) < BLOCK:
        if stop.requested or not vehicle.advance():
            return False
        states.append(vehicle.state)
    return True


class _Keeper:
    """Takes blocks of states through the pipeline into the sink, and notes the jumps among them."""

    def __init__(
        self, pipeline: Pipeline, sink: Sink, flown: Flown, progress: Progress | None
    ) -> None:
        self._pipeline, self._sink, self._flown, self._progress = pipeline, sink, flown, progress
        self._before: VehicleState | None = None
        self._jumping = False

    def keep(self, states: list[VehicleState]) -> None:
        """Take one block."""
        for tick in self._pipeline.block(states):
            self._sink.append(tick)
            self._note_jump(tick.vehicle)
            self._flown.ticks, self._flown.time = self._flown.ticks + 1, tick.vehicle.time
        if self._progress:
            self._progress(self._flown.time)

    def _note_jump(self, now: VehicleState) -> None:
        jump = attitude_jump(self._before, now) if self._before else 0.0
        self._before = now
        if (jump >= JUMP) != self._jumping:
            self._jumping = not self._jumping
            reason = (
                f"attitude jumped by {degrees(jump):.3g} deg that the body rates do not explain"
                if self._jumping
                else ""
            )
            self._sink.status(now.time, "attitude_jump" if self._jumping else "running", reason)


def _load(scenario: Scenario, flown: Flown) -> Vehicle | None:
    """The vehicle at its first state; none when it fails there, which is a result of the run."""
    flight = scenario.flight
    try:
        with scenario.naming_file():
            return (
                SignalVehicle(flight) if isinstance(flight, SignalFlight) else JsbsimVehicle(flight)
            )
    except VehicleError as error:
        flown.result, flown.reason = "vehicle_failed", str(error)
        return None


def _record(
    vehicle: Vehicle | None,
    pipeline: Pipeline | None,
    sink: Sink,
    flown: Flown,
    progress: Progress | None,
) -> None:
    """Fly, and finish the log whatever happens."""
    sink.status(0.0, "running", "")
    try:
        if vehicle and pipeline:
            with StopRequest() as stop:
                fly(vehicle, pipeline, sink, flown, progress, stop)
            if stop.requested:
                flown.result, flown.reason = "interrupted", f"asked to stop at {flown.time:.3f} s"
    except VehicleError as error:
        flown.result, flown.reason = "vehicle_failed", str(error)
    except KeyboardInterrupt:
        flown.result, flown.reason = "interrupted", f"asked to stop at {flown.time:.3f} s"
    except OutputError:
        raise
    except BaseException as error:
        flown.result, flown.reason = "failed", f"{type(error).__name__}: {error}"
        _finish(sink, flown)
        raise
    _finish(sink, flown)


def _finish(sink: Sink, flown: Flown) -> None:
    sink.status(flown.time, "done" if flown.result == "ok" else flown.result, flown.reason)
    sink.close(flown.result, flown.reason)


def _metadata(scenario: Scenario) -> dict[str, str]:
    versions = {f"{name}_version": version(name) for name in ("atlas_cueing", "jsbsim", "ruckig")}
    return {
        "scenario": scenario.name,
        "method": scenario.file.cueing.method,
        "platform": scenario.platform.name,
        **versions,
    }
