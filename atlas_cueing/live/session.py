"""A live run from a scenario to a finished log: everything put together, run, and taken apart."""

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import asdict
from math import degrees, radians
from pathlib import Path

from ..recording import McapRecorder
from ..run import Evaluation, LiveFigures, RunResult, build_pipeline, evaluate_log, open_recorder
from ..scenario import Scenario
from ..telemetry import HelperWatch, LiveWriter, OperatorButtons, Ring, live_ring
from ..wheels import Wheels
from .clock import MonotonicClock
from .control import (
    DriveFeedback,
    DriveMonitor,
    Guard,
    LiveController,
    OperatorInputs,
    PlatformController,
    RunOutcome,
)
from .held_attitude import held_attitude
from .input import Source, no_vehicle
from .kept_contacts import contact_check
from .live_options import LiveOptions
from .loop import Drives, Loop, Output
from .open_source import open_source
from .output import PoseProcess, Recorded, RecorderProcess, limits_hash
from .realtime import RealtimeScheduling, collections, realtime_scheduling
from .timing import LoopTiming

# rad and m that what was sent may be behind what was commanded
_MOST_BEHIND = (radians(0.1), 1e-3)
RING_SECONDS = 10.0  # that the recorder may be held up without a loss
# ticks; the figures of a longer run are left to review (20 minutes at 500 Hz, some 400 MB)
MOST_EVALUATED = 600_000
_WARM_UP = 200  # ticks of a pipeline that nothing follows: first calls are slow
_UNRECORDED = ("recording_failed", "recorder_died")


class LiveSession:
    """One live run.

    Processes that follow `ring` or press `buttons` have to be forked between `__init__` and `run`.

    ring: every tick and change of state of the run.
    buttons: the operator's.
    helpers: the processes that follow the run; the recorder is one of them.
    started_ns: start of the run, ns since 1970.
    """

    def __init__(self, scenario: Scenario, log: str | Path, options: LiveOptions) -> None:
        """Load everything that `run` needs.

        Raises InputError (nothing was written) when the scenario cannot fly live or at that rate.
        """
        options.check()
        self._scenario = scenario
        self._log = Path(log)
        self._options = options
        self._dt = round(1e9 / options.rate) / 1e9
        self._pipeline = build_pipeline(scenario, self._dt)
        self._attitude = held_attitude(scenario.platform, options.feedback, self._dt, options.pose)
        self._source: Source = open_source(scenario, options.listen)
        self.ring: Ring = live_ring(RING_SECONDS, options.rate)
        self.buttons = OperatorButtons()
        self.helpers = HelperWatch()
        self._clock = MonotonicClock()
        # the same moment by the loop's clock and by the system's
        self._origin, self.started_ns = self._clock.now(), time.time_ns()

    @property
    def corrects(self) -> bool:
        """Whether the attitude is corrected."""
        return self._attitude is not None

    def run(
        self,
        drives: Sequence[Drives] = (),
        stop_requests: Callable[[], int] = int,
        feedback: DriveFeedback | None = None,
    ) -> RunResult:
        """Fly until the run is over, and finish the log.

        Args:
            drives: take every command.
            stop_requests: returns how often the process has been asked to end.
            feedback: where the drives' words come from; None when they do not speak.
        """
        spoken = "monitored" if feedback else "one-way" if drives else "none"
        with closing(self._source):
            recorder = RecorderProcess(
                self.ring, self._recorder(spoken), announce=self._options.announce
            )
            self.helpers.add(
                lambda: recorder.alive, "the recorder has died: nothing more is recorded"
            )
            keeper, carries = self._pose_process(), bool(drives) and self._options.occupied
            monitor = self._monitor(feedback)
            controller = self._controller(stop_requests, monitor, carries=carries)
            writer = LiveWriter(self.ring, self._attitude)
            outputs: list[Output] = [writer, keeper] if keeper else [writer]
            drives = [*drives, keeper] if keeper else drives
            loop = Loop(
                *(self._dt, self._clock, controller, outputs, drives, self._origin),
                lead=self._options.lead,
            )
            try:
                realtime = self._run_loop(loop)
            finally:
                outcome = controller.outcome
                writer.end(loop.time, outcome.result, outcome.reason)
                recorded = recorder.finish()
                unkept = keeper.finish() if keeper else ""
        told: dict[str, float | str] = {"drive_status": spoken}
        told |= monitor.figures() if monitor else {}
        found = [("setpoints_unsent", monitor.finding if monitor else ""), ("pose_unkept", unkept)]
        return self._result(outcome, recorded, loop, realtime, told, found)

    def _pose_process(self) -> PoseProcess | None:
        """Start to keep the pose, where that is wanted."""
        file, platform = self._options.pose_file, self._scenario.platform
        if file is None:
            return None
        limits = platform.wheel_limit_values(), platform.stage_limit_values()
        J = Wheels(platform.geometry()).sphere_from_wheels
        return PoseProcess(file, platform.name, limits, J, self._options.pose)

    def _monitor(self, feedback: DriveFeedback | None) -> DriveMonitor | None:
        platform = self._scenario.platform
        limits = limits_hash(platform.wheel_limit_values(), platform.stage_limit_values())
        if feedback is None:
            return None
        options = self._options
        return DriveMonitor(
            feedback, limits, options.drive_timeout, self._attitude, options.drive_tolerance
        )

    def _controller(
        self, stop_requests: Callable[[], int], monitor: DriveMonitor | None, *, carries: bool
    ) -> LiveController:
        options, platform = self._options, self._scenario.platform
        limits = platform.stage_limit_values()
        self._warm_up()
        wheels = Wheels(platform.geometry())
        platform_controller = PlatformController(
            lambda: build_pipeline(self._scenario, self._dt),
            wheels.wheels_from_sphere,
            wheels.sphere_from_wheels,
            platform.wheel_limit_values(),
            limits,
            self._dt,
            options.pose,
        )
        guard = Guard(self._dt, platform.wheel_limit_values(), limits, contact_check(platform))
        operator = OperatorInputs(
            *(self.buttons.edges, stop_requests, options.duration, options.attended),
            losses=self.helpers.losses,
            carries=carries,
        )
        controller = LiveController(
            platform_controller, guard, self._source, operator, monitor, self._attitude
        )
        if options.engage and options.pose.is_home:
            controller.engage()
        return controller

    def _warm_up(self) -> None:
        """Run a pipeline that nothing follows, so that no first call falls into a tick."""
        for k in range(_WARM_UP):
            self._pipeline.step(no_vehicle(k * self._dt))

    def _run_loop(self, loop: Loop) -> RealtimeScheduling:
        """Run the loop; return what the system granted it."""
        with realtime_scheduling(self._options.priority) as realtime:
            before = collections()
            loop.run()
            loop.timing.collections = collections() - before
        return realtime

    def _result(
        self,
        outcome: RunOutcome,
        recorded: Recorded,
        loop: Loop,
        realtime: RealtimeScheduling,
        told: Mapping[str, float | str],
        found: Sequence[tuple[str, str]],
    ) -> RunResult:
        unrecorded = outcome.result == "ok" and recorded.result in _UNRECORDED
        ended = recorded if unrecorded else outcome
        result, reason = ended.result, ended.reason
        if result == "ok":
            findings = [(name, text) for name, text in (*found, _unsent(loop.timing)) if text]
            result, reason = findings[0] if findings else ("ok", "")
        figures = LiveFigures(
            *(outcome.faults, outcome.dropped, recorded.lost, loop.timing.to_json()),
            *(asdict(realtime), told),
        )
        return RunResult(
            result,
            reason,
            self._log,
            loop.ticks,
            loop.time,
            evaluation=self._evaluation(loop.ticks),
            live=figures,
        )

    def _recorder(self, spoken: str) -> McapRecorder:
        rate = f"{self._options.rate:g}"
        started = self.started_ns
        return open_recorder(
            *(self._scenario, self._log),
            started_ns=started,
            live="true",
            rate_hz=rate,
            drive_status=spoken,
            attitude=self._attitude is not None,
        )

    def _evaluation(self, ticks: int) -> Evaluation:
        if ticks > MOST_EVALUATED or not self._log.exists():
            return Evaluation()
        return evaluate_log(self._log, self._scenario.platform)


def _unsent(timing: LoopTiming) -> tuple[str, str]:
    """Return result and reason of a run that has kept all else: did the set points go out?"""
    wheels, stage = timing.wheel_difference, timing.stage_difference
    if wheels <= _MOST_BEHIND[0] and stage <= _MOST_BEHIND[1]:
        return "ok", ""
    return "setpoints_unsent", (
        f"the wheels were commanded {degrees(wheels):.2f} deg and the stage {1e3 * stage:.2f} mm"
        " beyond the last set point that could be sent, allowed: 0.1 deg and 1 mm"
    )
