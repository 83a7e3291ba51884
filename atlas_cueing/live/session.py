"""A live run from a scenario to a finished log.

Everything put together, run, and taken apart again.
"""

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack, closing
from dataclasses import asdict, dataclass
from pathlib import Path

from ..errors import InputError
from ..recording import McapRecorder
from ..run import Evaluation, LiveFigures, RunResult, build_pipeline, evaluate_log, open_recorder
from ..scenario import Scenario
from ..telemetry import LiveWriter, Ring, live_ring
from ..telemetry.operator_buttons import OperatorButtons
from .clock import MonotonicClock
from .control.controller import LiveController, OperatorInputs
from .control.guard import Guard
from .control.platform_controller import PlatformController, no_vehicle
from .input.source import Source
from .loop import Drives, Loop
from .open_source import open_source
from .output.recorder_process import RecorderProcess
from .realtime import collections, punctual

RATES = (100.0, 1000.0)  # Hz, lowest and highest of the loop
DEFAULT_RATE = 500.0  # Hz
RING_SECONDS = 10.0  # that the recorder may be held up without a loss
# ticks; the figures of a longer run are left to review (20 minutes at 500 Hz, some 400 MB)
MOST_EVALUATED = 600_000
_WARM_UP = 200  # ticks flown for nothing: first calls are slow


@dataclass(frozen=True, slots=True)
class LiveOptions:
    """How to run: loop rate in Hz, duration in s until parking.

    `attended` runs wait for their operator's buttons.

    priority: ask the system for SCHED_FIFO, locked memory and a core of its own. announce: tell
        changes of state on stderr.
    """

    rate: float = DEFAULT_RATE
    duration: float = float("inf")
    attended: bool = False
    engage: bool = True
    priority: bool = False
    announce: bool = False


class LiveSession:
    """One live run.

    Followers of `ring`, and whoever presses `buttons`, have to be forked between `__init__` and
    `run`.
    """

    def __init__(self, scenario: Scenario, log: str | Path, options: LiveOptions) -> None:
        """Load everything.

        Raises InputError (nothing was written) when the scenario cannot fly live or at that rate.
        """
        if not RATES[0] <= options.rate <= RATES[1]:
            raise InputError(
                f"--rate {options.rate:g} Hz, allowed: {RATES[0]:g} <= rate <= {RATES[1]:g}"
            )
        self._scenario, self._log, self._options = scenario, Path(log), options
        self._dt = 1.0 / options.rate
        self._pipeline = build_pipeline(scenario, self._dt)
        self._source: Source = open_source(scenario)
        self.ring: Ring = live_ring(RING_SECONDS, options.rate)
        self.buttons = OperatorButtons()
        self._clock = MonotonicClock()
        # one moment, by the loop's clock and by the wall's
        self._origin, self.started_ns = self._clock.now(), time.time_ns()

    def run(self, drives: Sequence[Drives] = (), signals: Callable[[], int] = int) -> RunResult:
        """Fly until the run is over, and finish the log.

        `signals` tells how often the process has been asked to end.
        """
        with ExitStack() as stack:
            stack.enter_context(closing(self._source))
            recorder = RecorderProcess(self.ring, self._recorder(), announce=self._options.announce)
            asked = OperatorInputs(
                self.buttons.edges, signals, self._options.duration, self._options.attended
            )
            conductor = self._conductor(asked)
            writer = LiveWriter(self.ring)
            loop = Loop(self._dt, self._clock, conductor, [writer], drives, self._origin)
            try:
                with punctual(self._options.priority) as realtime:
                    before = collections()
                    loop.run()
                    loop.timing.collections = collections() - before
            finally:
                writer.end(loop.time, conductor.ended.result, conductor.ended.reason)
                recorded = recorder.finish()
        ended = conductor.ended
        if recorded.result in ("recording_failed", "recorder_died"):
            ended.because(recorded.result, recorded.reason)
        figures = LiveFigures(
            ended.faults, ended.dropped, recorded.lost, loop.timing.to_json(), asdict(realtime)
        )
        return RunResult(
            ended.result,
            ended.reason,
            self._log,
            loop.ticks,
            loop.time,
            evaluation=self._evaluation(loop.ticks),
            live=figures,
        )

    def _conductor(self, wishes: OperatorInputs) -> LiveController:
        platform = self._scenario.platform
        limits = platform.stage_limit_values()
        self._warm_up()
        ride = PlatformController(
            lambda: build_pipeline(self._scenario, self._dt),
            platform.geometry().sphere_from_wheels,
            limits.travel,
            self._dt,
        )
        guard = Guard(self._dt, platform.wheel_limit_values(), limits)
        conductor = LiveController(ride, guard, self._source, wishes)
        if self._options.engage:
            conductor.engage()
        return conductor

    def _warm_up(self) -> None:
        """Fly a pipeline of its own through the first state, so that no first call falls into a tick."""
        for k in range(_WARM_UP):
            self._pipeline.step(no_vehicle(k * self._dt))

    def _recorder(self) -> McapRecorder:
        rate = f"{self._options.rate:g}"
        started = self.started_ns
        return open_recorder(
            self._scenario, self._log, started_ns=started, live="true", rate_hz=rate
        )

    def _evaluation(self, ticks: int) -> Evaluation:
        if ticks > MOST_EVALUATED or not self._log.exists():
            return Evaluation()
        return evaluate_log(self._log, self._scenario.platform)
