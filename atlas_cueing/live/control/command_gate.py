"""The last step of a tick: what goes out to the drives, and what the log has of it."""

# mypyc: runs every tick

from dataclasses import replace

from ...signals import Tick, VehicleState
from .attitude_correction import AttitudeCorrection
from .command import Command, command_of, standstill
from .guard import Guard
from .platform_controller import PlatformController


class CommandGate:
    """Has the guard check each motion, and flies the guard's stop where there is none.

    A motion that was made too late for its slot waits here for the next one.
    """

    def __init__(
        self,
        platform: PlatformController,
        guard: Guard,
        attitude: AttitudeCorrection | None = None,
    ) -> None:
        """Start where the platform stands; `attitude` corrects what goes out, the last of all."""
        self._platform, self._guard, self._attitude = platform, guard, attitude
        # the last motion and command that went out
        self._last_motion = platform.motion
        self._last = standstill(platform.motion, platform.wheel_angle)
        self._waiting: Tick | None = None  # made when it was too late for it; not gone out yet
        guard.start(self._last)

    @property
    def standing(self) -> bool:
        """Whether the last command was exactly at rest."""
        return self._guard.standing

    @property
    def settled(self) -> bool:
        """Whether what went out last, correction included, was exactly at rest."""
        return self.standing and (self._attitude is None or self._attitude.standing)

    @property
    def reason(self) -> str:
        """Why the guard stops."""
        return self._guard.reason

    def restart(self) -> None:
        """After a stop: go on from where it has ended."""
        self._guard.start(standstill(self._last_motion, self._last.wheel_angle))
        if self._attitude:
            self._attitude.restart()

    def stand(self, vehicle: VehicleState) -> Tick:
        """Return a tick that stands where the platform stands."""
        return self._platform.standing_tick(self._last_motion, vehicle)

    def keep(self, tick: Tick) -> None:
        """Keep a motion that was made too late for its slot."""
        self._waiting = tick

    def next_motion(self, vehicle: VehicleState) -> Tick:
        """Return the motion that waits to go out, or else the next one."""
        if self._waiting is None:
            return self._platform.step(vehicle)
        tick, self._waiting = _retimed(self._waiting, vehicle.time), None
        return tick

    def release(self, time: float, tick: Tick | None) -> Command:
        """Return the command of the tick if the guard lets it pass, or the next of its stop."""
        if tick is None:
            return self._guard.stop(time)
        angle = self._platform.wheel_angle if self._waiting is None else self._last.wheel_angle
        return self._guard.check(command_of(tick, angle), tick.motion.q_WS)

    def sent(self, tick: Tick | None, command: Command, vehicle: VehicleState) -> tuple[Tick, bool]:
        """Note the command that goes out; return its tick, and whether it is one of a stop."""
        stopped = tick is None or self._guard.stopping
        if tick is None or stopped:
            tick = self._platform.commanded_tick(
                self._last_motion, self._last.wheel_angle, vehicle, command
            )
            self._waiting = None
        self._last_motion, self._last = tick.motion, command
        return tick, stopped

    def corrected(self, due: int, tick: Tick, command: Command) -> Command:
        """Return what the drives get for a command that has been let pass, due then (ns)."""
        if self._attitude is None:
            return command
        q_WS, stopping = tick.motion.q_WS, self._guard.stopping
        return self._attitude.corrected(due, command, q_WS, stopping=stopping)


def _retimed(tick: Tick, time: float) -> Tick:
    """Return the tick as one of another time (s)."""
    return Tick(
        replace(tick.vehicle, time=time),
        replace(tick.cue, time=time),
        replace(tick.motion, time=time),
        replace(tick.wheels, time=time),
    )
