"""A live run without waiting: a clock under control, faults on demand, all commands kept."""

import tempfile
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from math import inf
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.controller import LiveController
from atlas_cueing.live.control.drive_monitor import MOST_OFF, TIMEOUT, DriveMonitor
from atlas_cueing.live.control.drive_status import DriveFeedback
from atlas_cueing.live.control.guard import Guard
from atlas_cueing.live.control.operator_inputs import OperatorInputs
from atlas_cueing.live.control.platform_controller import PlatformController
from atlas_cueing.live.control.pose import Pose
from atlas_cueing.live.control.slot import Slot
from atlas_cueing.live.control.state_machine import State
from atlas_cueing.live.held_attitude import held_attitude
from atlas_cueing.live.loop import LEAD, Drives, Loop
from atlas_cueing.live.output.hello import limits_hash
from atlas_cueing.pipeline import Pipeline
from atlas_cueing.run import build_pipeline
from atlas_cueing.scenario import Scenario, load_scenario
from atlas_cueing.signals import Motion, Timing

from .rig_parts import FakeClock, Tape, TumblingSource, Wanted

Array = NDArray[np.float64]

ROUNDING = 1e-6  # share of a limit that differences over a tick may pass it by
_FILE = """
name = "live"
duration_s = 5.0
[vehicle]
source = "signal"
[[vehicle.signal]]
axis = "roll_rate"
shape = "sine"
amplitude_deg_s = 20.0
frequency_rad_s = 2.0
duration_s = 5.0
[platform]
preset = "{platform}"
"""


@cache
def scenario(platform: str = "atlas-2.9m", *settings: str) -> Scenario:
    """A scenario on this platform; its own vehicle is not flown."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "live.toml"
        file.write_text(_FILE.format(platform=platform))
        return load_scenario(file, settings)


class Rig:
    """Everything of a live run but the real time."""

    def __init__(
        self,
        dt: float = 0.01,
        platform: str = "atlas-2.9m",
        settings: Iterable[str] = (),
        *,
        attended: bool = True,
        duration: float = inf,
        rate: float = 0.6,
        lead: float = LEAD,
        drives: Sequence[Drives] = (),
        feedback: DriveFeedback | None = None,
        carries: bool = False,
        pose: Pose | None = None,
        corrected: str = "none",
        most_off: float = MOST_OFF[0],
    ) -> None:
        self.dt, self.scenario = dt, scenario(platform, *settings)
        limits = self.scenario.platform
        self.wheel_limits, self.stage_limits = (
            limits.wheel_limit_values(),
            limits.stage_limit_values(),
        )
        self.source, self.clock, self.tape, self.wanted = (
            TumblingSource(dt, rate),
            FakeClock(),
            Tape(),
            Wanted(),
        )
        self.platform = PlatformController(
            self.pipeline,
            limits.geometry().wheels_from_sphere,
            limits.geometry().sphere_from_wheels,
            self.wheel_limits,
            self.stage_limits,
            dt,
            pose,
        )
        self.guard = Guard(dt, self.wheel_limits, self.stage_limits)
        operator = OperatorInputs(
            *(self.wanted.edges, lambda: self.wanted.signals, duration, attended), carries=carries
        )
        limits_told = limits_hash(self.wheel_limits, self.stage_limits)
        self.attitude = held_attitude(limits, corrected, dt, pose or Pose())
        self.monitor = (
            DriveMonitor(feedback, limits_told, TIMEOUT, self.attitude, most_off)
            if feedback
            else None
        )
        self.controller = LiveController(
            self.platform, self.guard, self.source, operator, self.monitor, self.attitude
        )
        outputs, sinks = [self.tape], [self.tape, *drives]
        self.loop = Loop(dt, self.clock, self.controller, outputs, sinks, lead=lead)
        self.start = self.clock.now() + dt
        self.slot = 0

    def pipeline(self) -> Pipeline:
        return build_pipeline(self.scenario, self.dt)

    @property
    def state(self) -> State:
        return self.controller.state

    @property
    def motion(self) -> Motion:
        return self.platform.motion

    def tick(self, lateness: float = 0.0) -> Command:
        """One tick without the loop; keeps what comes of it."""
        self.slot += 1
        elapsed = self.slot * self.dt
        slot = Slot(lambda: lateness, elapsed, LEAD)
        tick, command = self.controller.tick(slot)
        self.tape.tick(tick, Timing(elapsed, elapsed, lateness, 0.0, 0.0, 0.0, self.state.number))
        self.tape.commands.append(command)
        for state, reason in self.controller.take_changes():
            self.tape.status(elapsed, state.value, reason)
        return command

    def fly(self, seconds: float) -> None:
        for _ in range(round(seconds / self.dt)):
            self.tick()

    def until(self, what: State | Callable[[], bool], seconds: float) -> float:
        """Tick until then; how long it took, s. It has to be within `seconds`."""
        reached = (lambda: self.state is what) if isinstance(what, State) else what
        for k in range(round(seconds / self.dt) + 1):
            if reached():
                return k * self.dt
            self.tick()
        raise AssertionError(
            f"{what} not reached within {seconds} s; {self.state}, {self.tape.statuses[-3:]}"
        )

    def press(self, *names: str) -> None:
        self.wanted.buttons += names

    def bring_to(self, state: State) -> None:
        """From the start into a state, by what leads there."""
        if state is State.PARKED:
            self.fly(0.1)
            return
        self.source.quiet = state is State.WAITING
        self.fly(0.2 if state is State.WAITING else 0.0)
        self.press("engage")
        self.until(State.ENGAGING, 0.1)
        if state is State.WAITING:
            self.until(State.WAITING, 2.0)
            self.source.quiet = False
            return
        self.until(lambda: self.platform.tracking, 2.0)
        self.fly(2.5)
        if state is State.ENGAGING:
            return
        self.until(State.RUNNING, 6.0)
        self.fly(1.0)
        if state in (State.HOLDING, State.PARKING):
            self.press("hold" if state is State.HOLDING else "park")
            self.tick()
        if state is State.PARKING:
            self.fly(1.2)
        if state in (State.FAULT_STOPPING, State.STOPPED):
            self.tick(lateness=0.025)
        if state is State.STOPPED:
            self.until(State.STOPPED, 5.0)
        assert self.state is state

    def excess(self) -> float:
        """Largest share used of any limit by the commands and their differences, less one.

        Before them it stood still.
        """
        return excess(self.dt, self.tape.commands, self)


def excess(dt: float, commands: Sequence[Command], rig: Rig) -> float:
    wheels, stage = rig.wheel_limits, rig.stage_limits
    w, b = (
        np.array([c.wheel_speed for c in commands]),
        np.array([c.wheel_acceleration for c in commands]),
    )
    p, v, a = (
        np.array([getattr(c, name) for c in commands]) for name in ("p_WS_W", "v_WS_W", "a_WS_W")
    )
    w, b, v, a = (np.vstack([np.zeros((3, 3)), each]) for each in (w, b, v, a))
    p = np.vstack([p[:1]] * 3 + [p])
    shares = [p / stage.travel]
    for speed, acceleration, limits in ((w, b, wheels), (v, a, stage)):
        shares += [speed / limits.speed, acceleration / limits.acceleration]
        shares += [
            np.diff(speed, axis=0) / dt / limits.acceleration,
            np.diff(speed, 2, axis=0) / dt**2 / limits.jerk,
        ]
        shares += [np.diff(acceleration, axis=0) / dt / limits.jerk]
    for order, limit in enumerate((stage.speed, stage.acceleration, stage.jerk), 1):
        shares.append(np.diff(p, order, axis=0) / dt**order / limit)
    assert all(np.all(np.isfinite(share)) for share in shares)
    assert np.all(np.diff([c.time for c in commands]) > 0.0)
    return float(max(np.max(np.abs(share)) for share in shares)) - 1.0
