"""The last check before the drives.

A command is what the platform can do next, or the certified stop takes its place. The guard shares
no arithmetic with smoothing, whose mistakes it is there to catch. The last output is (p, v, a) per
wheel or stage axis; with travel T, speed V, acceleration A and jerk J at most, and ticks of length
h, the next one is fit only if some motion of jerk at most J leads to it in one tick. Let
D = a1 - a0 and m = h (a0 + a1) / 2 - (v1 - v0). Then, exactly,

    |D| <= J h      |m| <= (J h^2 - D^2 / J) / 4      -f(h + D / J) <= 2 (p1 - c) <= f(h - D / J)

    c = p0 + h (v0 + v1) / 2 - h^2 D / 8            f(d) = J (h^3 / 12 - d^3 / 48) - m^2 / (J d)

since the extremes have jerk J at both ends of the tick and -J for d / 2 between, or the reverse: D
fixes how long that is, m where it lies, and 2 (p1 - c) is the jerk's second moment about the middle
of the tick. As such a motion goes through all outputs, their differences keep J to any order; that
they keep A and V as well is required of each pair.

Where the platform keeps traction, friction, normal forces and torques are checked as well
(`contact_check`), and the stop is the soft one that keeps them: smoothing has certified it.

The angle of a wheel is checked as the place of a rail is, without travel.

Then its stop: speed, and on the stage travel, hold from there to standstill, in continuous time. So
every output has a successor: one tick along its own stop. Each wheel and each axis of W stops on
its own.
"""

# mypyc: runs every tick

from math import inf, ulp

from ...errors import InputError
from ...rotation import IDENTITY, ZERO, Quat
from ...signals import StageLimits, WheelLimits
from .certified_axis import AxisLimits, CertifiedStop, outside
from .command import Command, axes_of, command_from, is_still
from .contact_check import ContactCheck

_EARLY = 1e-6  # share of a tick by which a command may be early, beside the rounding of its time
# s; a command may come so much late; after that the drives were left alone too long (assumed)
_LATE = 0.1
_AGES = 1e10  # s; no clock shows more, and below it ticks of 1 ms are distinct


class Guard:
    """Lets fit commands through and stops the platform, for good, at the first one that is not.

    It starts at rest in the centre, at the time that the first command has. Commands follow each
    other by one tick of motion; their times by a tick or more, for a late one only makes the same
    differences flatter. Numbers that are not finite are inside no limits.
    """

    def __init__(
        self,
        dt: float,
        wheel_limits: WheelLimits,
        stage_limits: StageLimits,
        contacts: ContactCheck | None = None,
    ) -> None:
        """Start at rest in the centre; tick dt in s, limits in SI units.

        contacts: checks traction and torque, where the platform keeps them.

        Raises InputError for a tick or limits that are not positive, or leave no travel between two
        ticks.
        """
        wheels, stage = wheel_limits, stage_limits
        self._dt, self._contacts = dt, contacts
        turns = [
            AxisLimits(f"wheel {name} ", dt, v, a, j, inf, wheels.stop_share)
            for name, v, a, j in zip(
                "123", wheels.speed, wheels.acceleration, wheels.jerk, strict=True
            )
        ]
        self._rails = [
            _rail(f"stage {name} ", dt, v, a, j, travel, stage.stop_share)
            for name, v, a, j, travel in zip(
                "xyz", stage.speed, stage.acceleration, stage.jerk, stage.travel, strict=True
            )
        ]
        self._axes = [*turns, *self._rails]
        self._begin(Command(0.0, ZERO, ZERO, ZERO, ZERO, ZERO, ZERO))
        self._earliest, self._latest = -_AGES, _AGES

    def start(self, command: Command) -> None:
        """Open (again) at a command that stands still inside the travel, at any time.

        Raises InputError for any other one.
        """
        breach = outside("", "time", command.time, -_AGES, _AGES)
        for rail, p in zip(self._rails, command.p_WS_W, strict=True):
            breach = breach or outside(rail.name, "position", p, -rail.travel, rail.travel)
        for rate in _rates(command):
            breach = breach or outside("", "a rate", rate, 0.0, 0.0)
        if breach:
            raise InputError(f"start from a standstill inside the travel: {breach}")
        self._begin(command)

    def check(self, command: Command, q_WS: Quat = IDENTITY) -> Command:
        """Return the command if it is fit to follow the last output.

        q_WS: orientation of the cabin that belongs to it, for traction.

        Otherwise, and from then on, return the next tick of the stop.
        """
        if not self.stopping:
            try:
                breach = self._breach(command, q_WS)
                if not breach:
                    self._put_out(command)
                    return command
            except (ArithmeticError, TypeError, ValueError) as error:
                breach = f"no command at all: {error}"
            self._latch(f"{breach}, at {command.time} s")
        return self.stop(command.time)

    def stop(self, time: object) -> Command:
        """Return the next tick of the stop, for a tick at `time` (s) that has no command.

        From then on every tick belongs to the stop. A time that is none is made up.
        """
        if not self.stopping:
            self._latch(f"no command at {time} s")
        self._ticks += 1
        if not (isinstance(time, float | int) and self._earliest <= time <= self._latest):
            time = self._last.time + self._dt
        ways = [stop.at(self._ticks * self._dt) for stop in self._stops]
        self._put_out(command_from(time, ways))
        return self._last

    @property
    def reason(self) -> str:
        """Why it stops: quantity, value, lower <= value <= upper, time in s.

        Empty while it does not.
        """
        return self._reason

    @property
    def stopping(self) -> bool:
        """Whether it stops or has stopped the platform."""
        return self._reason != ""

    @property
    def standing(self) -> bool:
        """Whether the last output is at rest."""
        return is_still(self._last)

    def _begin(self, command: Command) -> None:
        self._reason, self._ticks, self._stops = "", 0, list[CertifiedStop]()
        self._put_out(command)

    def _put_out(self, command: Command) -> None:
        self._earliest = command.time + self._dt * (1.0 - _EARLY) - 2.0 * ulp(command.time)
        self._latest = command.time + self._dt + _LATE
        self._last = command

    def _latch(self, reason: str) -> None:
        """Plan the stop from the last output."""
        states = zip(self._axes, axes_of(self._last), strict=True)
        self._stops = [axis.stop(*state) for axis, state in states]
        self._reason = reason

    def _breach(self, command: Command, q_WS: Quat) -> str:
        """Describe the first thing that is not fit to follow the last output, axis by axis."""
        return (
            outside("", "time", command.time, self._earliest, self._latest)
            or self._axis_breach(command)
            or ("" if self._contacts is None else self._contacts.breach(command, q_WS))
        )

    def _axis_breach(self, command: Command) -> str:
        states = axes_of(self._last), axes_of(command)
        for axis, before, now in zip(self._axes, *states, strict=True):
            p0, v0, a0 = before
            p, v, a = now
            if breach := axis.breach(self._dt, p0, v0, a0, p, v, a):
                return breach
        return ""


def _rail(
    name: str,
    dt: float,
    speed: float,
    acceleration: float,
    jerk: float,
    travel: float,
    stop_share: float,
) -> AxisLimits:
    """Return the limits of an axis of the stage, which has a travel left between two ticks."""
    rail = AxisLimits(name, dt, speed, acceleration, jerk, travel, stop_share)
    unused = acceleration * dt * dt / 8.0
    if not unused < travel < inf:
        raise InputError(f"{name}travel {travel:g} m, allowed: {unused:.3g} < value < inf")
    return rail


def _rates(command: Command) -> tuple[float, ...]:
    """Return all numbers of a command that are zero at a standstill."""
    return (*command.wheel_speed, *command.wheel_acceleration, *command.v_WS_W, *command.a_WS_W)
