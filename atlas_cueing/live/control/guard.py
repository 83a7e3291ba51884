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

Then its stop: speed, and on the stage travel, hold from there to standstill, in continuous time. So
every output has a successor: one tick along its own stop. Each wheel and each axis of W stops on
its own.
"""

# mypyc: runs every tick

from collections.abc import Iterable, Iterator
from math import copysign, inf, sqrt, ulp

from ...errors import InputError
from ...rotation import ZERO, Vec3
from ...signals import StageLimits, WheelLimits
from .command import Command

# share by which a limit may be passed, as differences of rounded numbers do; the stop has it, too
_ROUNDING = 5e-7
_EARLY = 1e-6  # share of a tick by which a command may be early, beside the rounding of its time
# s; a command may come so much late; after that the drives were left alone too long (assumed)
_LATE = 0.1
_AGES = 1e10  # s; no clock shows more, and below it ticks of 1 ms are distinct

_Checks = tuple[tuple[str, float, float, float], ...]  # what, value, lowest and highest allowed


class Guard:
    """Lets fit commands through and stops the platform, for good, at the first one that is not.

    It starts at rest in the centre, at the time that the first command has. Commands follow each
    other by one tick of motion; their times by a tick or more, for a late one only makes the same
    differences flatter. Numbers that are not finite are inside no limits.
    """

    def __init__(self, dt: float, wheel_limits: WheelLimits, stage_limits: StageLimits) -> None:
        """Start at rest in the centre; tick dt in s, limits in SI units.

        Raises InputError for a tick or limits that are not positive, or leave no travel between two
        ticks.
        """
        wheels, stage = wheel_limits, stage_limits
        self._dt = dt
        self._wheels = [
            _Wheel(f"wheel {name} ", dt, *limit)
            for name, *limit in zip(
                "123", wheels.speed, wheels.acceleration, wheels.jerk, strict=True
            )
        ]
        self._rails = [
            _Rail(f"stage {name} ", dt, *limit)
            for name, *limit in zip(
                "xyz", stage.speed, stage.acceleration, stage.jerk, stage.travel, strict=True
            )
        ]
        self._begin(Command(0.0, ZERO, ZERO, ZERO, ZERO, ZERO))
        self._earliest, self._latest = -_AGES, _AGES

    def start(self, command: Command) -> None:
        """Open (again) at a command that stands still inside the travel, at any time.

        Raises InputError for any other one.
        """
        places = zip(self._rails, command.p_WS_W, strict=True)
        checks = [("", (("time", command.time, -_AGES, _AGES),))]
        checks += [(rail.name, (("position", p, -rail.travel, rail.travel),)) for rail, p in places]
        checks += [("", (("a rate", rate, 0.0, 0.0),)) for rate in _rates(command)]
        if breach := _breach(checks):
            raise InputError(f"start from a standstill inside the travel: {breach}")
        self._begin(command)

    def check(self, command: Command) -> Command:
        """Return the command if it is fit to follow the last output.

        Otherwise, and from then on, return the next tick of the stop.
        """
        if not self.stopping:
            try:
                breach = _breach(self._checks(command))
                if not breach:
                    self._put_out(command)
                    return command
            except (ArithmeticError, TypeError, ValueError) as error:
                breach = f"no command at all: {error}"
            self._latch(f"{breach}, at {command.time} s")
        return self.stop(command.time)

    def stop(self, time: float) -> Command:
        """Return the next tick of the stop, for a tick at `time` (s) that has no command.

        From then on every tick belongs to the stop.
        """
        if not self.stopping:
            self._latch(f"no command at {time} s")
        self._ticks += 1
        if not (isinstance(time, float | int) and self._earliest <= time <= self._latest):
            time = self._last.time + self._dt
        ways = [stop.at(self._ticks * self._dt) for stop in self._stops]
        (_, w1, b1), (_, w2, b2), (_, w3, b3), (px, vx, ax), (py, vy, ay), (pz, vz, az) = ways
        self._put_out(
            Command(time, (w1, w2, w3), (b1, b2, b3), (px, py, pz), (vx, vy, vz), (ax, ay, az))
        )
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
        return not any(_rates(self._last))

    def _begin(self, command: Command) -> None:
        self._reason, self._ticks, self._stops = "", 0, list[_Stop]()
        self._put_out(command)

    def _put_out(self, command: Command) -> None:
        self._earliest = command.time + self._dt * (1.0 - _EARLY) - 2.0 * ulp(command.time)
        self._latest = command.time + self._dt + _LATE
        self._last = command

    def _latch(self, reason: str) -> None:
        """Plan the stop from the last output."""
        last = self._last
        wheels = zip(self._wheels, ZERO, last.wheel_speed, last.wheel_acceleration, strict=True)
        rails = zip(self._rails, last.p_WS_W, last.v_WS_W, last.a_WS_W, strict=True)
        self._stops = [axis.stop(*state) for axis, *state in (*wheels, *rails)]
        self._reason = reason

    def _checks(self, command: Command) -> Iterator[tuple[str, _Checks]]:
        """Yield all that has to hold for the command to follow the last output, axis by axis."""
        last = self._last
        yield "", (("time", command.time, self._earliest, self._latest),)
        before = (last.wheel_speed, last.wheel_acceleration)
        after = (command.wheel_speed, command.wheel_acceleration)
        for wheel, v0, a0, v, a in zip(self._wheels, *before, *after, strict=True):
            yield wheel.name, wheel.checks(v0, a0, v, a)
        placed = (last.p_WS_W, last.v_WS_W, last.a_WS_W)
        place = (command.p_WS_W, command.v_WS_W, command.a_WS_W)
        for rail, p0, v0, a0, p, v, a in zip(self._rails, *placed, *place, strict=True):
            yield rail.name, rail.checks(v0, a0, v, a)
            yield rail.name, rail.place_checks(p0, v0, a0, p, v, a)


class _Wheel:
    """One axis whose position is free: its limits, with room for rounding, for one tick."""

    def __init__(
        self, name: str, dt: float, speed: float, acceleration: float, jerk: float
    ) -> None:
        for what, value in (
            ("tick", dt),
            ("speed", speed),
            ("acceleration", acceleration),
            ("jerk", jerk),
        ):
            if not 0.0 < value < inf:
                raise InputError(f"{name}{what} {value:g}, allowed: 0 < value < inf")
        self.name, self.dt = name, dt
        self.speed, self.acceleration, self.jerk = (
            x * (1.0 + _ROUNDING) for x in (speed, acceleration, jerk)
        )
        # for J in speed and position: rounding there, and h - |D| / J > 0
        self.reach = self.jerk * (1.0 + _ROUNDING)

    def checks(self, v0: float, a0: float, v: float, a: float) -> _Checks:
        """Return the checks from speed v0 and acceleration a0 to v and a, one tick later."""
        h, fast, strong = self.dt, self.speed, self.acceleration
        turn, gain, D = self.jerk * h, strong * h, a - a0
        mean, bend = v0 + 0.5 * h * (a0 + a), 0.25 * (self.reach * h * h - D * D / self.reach)
        return (
            ("speed", v, -fast, fast),
            ("acceleration", a, -strong, strong),
            ("acceleration by the jerk", a, a0 - turn, a0 + turn),
            ("speed by the acceleration", v, v0 - gain, v0 + gain),
            ("speed by the jerk", v, mean - bend, mean + bend),
            ("speed on the way to standstill", v + 0.5 * a * abs(a) / self.jerk, -fast, fast),
        )

    def stop(self, p: float, v: float, a: float) -> "_Stop":
        """Return the shortest stop from position p, speed v and acceleration a."""
        return _Stop(p, v, a, self.acceleration, self.jerk)


class _Rail(_Wheel):
    """One axis of the stage: as a wheel, but inside its travel.

    Between two ticks a motion leaves the line between its ends by A h^2 / 8 at most: so much of the
    travel is not used.
    """

    def __init__(
        self, name: str, dt: float, speed: float, acceleration: float, jerk: float, travel: float
    ) -> None:
        super().__init__(name, dt, speed, acceleration, jerk)
        unused = acceleration * dt * dt / 8.0
        if not unused < travel < inf:
            raise InputError(f"{name}travel {travel:g} m, allowed: {unused:.3g} < value < inf")
        self.travel = travel * (1.0 + _ROUNDING) - unused
        self._blur = 4.0 * ulp(travel)

    def place_checks(
        self, p0: float, v0: float, a0: float, p: float, v: float, a: float
    ) -> _Checks:
        """Return the checks from p0, v0, a0 to p, v, a, one tick later, if v and a are fit."""
        h, end, stop = self.dt, self.travel, self.stop(p, v, a)
        way, sag, old, new = (
            self.speed * h,
            0.5 * self.acceleration * h * h,
            p0 + h * v0,
            p0 + h * v,
        )
        low, high = self._reachable(p0, v0, a0, v, a)
        return (
            ("position", p, -end, end),
            ("position by the speed", p, p0 - way, p0 + way),
            ("position by the acceleration", p, old - sag, old + sag),
            ("position by the acceleration", p, new - sag, new + sag),
            ("position by the jerk", p, low, high),
            ("standstill", stop.end, -end, end),
            ("turning point", stop.turning_point, -end, end),
        )

    def _reachable(
        self, p0: float, v0: float, a0: float, v: float, a: float
    ) -> tuple[float, float]:
        """Return the lowest and the highest p to which a jerk-limited tick can lead."""
        h, D = self.dt, a - a0
        m = 0.5 * h * (a0 + a) - (v - v0)
        c, skew = p0 + 0.5 * h * (v0 + v) - h * h * D / 8.0, D / self.reach
        return (
            c - 0.5 * self._moment(m, h + skew) - self._blur,
            c + 0.5 * self._moment(m, h - skew) + self._blur,
        )

    def _moment(self, m: float, d: float) -> float:
        """Return f(d) of the module's text."""
        return self.reach * (self.dt * self.dt * self.dt / 12.0 - d * d * d / 48.0) - m * m / (
            self.reach * d
        )


class _Stop:
    """The shortest jerk-limited way from (p, v, a) to rest at `end`.

    With u = v + a|a| / 2J, the speed if a were brought to zero, v and a times u's sign brake
    downwards, along a trapezoid that begins with no acceleration and the speed s = v + a^2 / 2J, at
    a time -a / J after now: a ramp of min(A / J, sqrt(s / J)), max(s / A - A / J, 0) at full
    deceleration, a ramp back. (p, v, a) is a point of that trapezoid, or of its first ramp drawn
    backwards when a speeds it up; drawn further than sqrt(2 s / J), where v was zero, it goes the
    other way first, to the `turning_point`, which is p if it does not.
    """

    def __init__(self, p: float, v: float, a: float, acceleration: float, jerk: float) -> None:
        sign = copysign(1.0, v + 0.5 * a * abs(a) / jerk)
        top = sign * v + 0.5 * a * a / jerk
        self._ramp, self._hold = acceleration / jerk, top / acceleration - acceleration / jerk
        if self._hold < 0.0:
            self._ramp, self._hold = sqrt(top / jerk), 0.0
        self._jerk = sign * jerk
        self._since, turn = -a / self._jerk, -sqrt(2.0 * top / jerk)
        begin = p + (self._jerk * self._since * self._since / 6.0 - sign * top) * self._since
        self.end = begin + sign * top * (self._ramp + 0.5 * self._hold)
        self.turning_point = begin + sign * top * turn / 1.5 if self._since < turn else p

    def at(self, t: float) -> Vec3:
        """Return position, speed and acceleration t >= 0 s after its start.

        They are integrated backwards from the end: every sum is one of products, and zero at the
        end to the last bit.
        """
        now, ramp, hold = self._since + t, self._ramp, self._hold
        # s, left of the last ramp, of the hold, of the first ramp
        z = min(max(2.0 * ramp + hold - now, 0.0), ramp)
        y = min(max(ramp + hold - now, 0.0), hold)
        x = max(ramp - now, 0.0)
        left = (
            z * z * z / 6.0 + 0.5 * z * y * (z + y) + z * x * (0.5 * (z + x) + y) - x * x * x / 6.0
        )
        speed = 0.5 * (z * z - x * x) + z * (y + x)
        return self.end - self._jerk * left, self._jerk * speed, self._jerk * (x - z)


def _rates(command: Command) -> tuple[float, ...]:
    """Return all numbers of a command that are zero at a standstill."""
    return (*command.wheel_speed, *command.wheel_acceleration, *command.v_WS_W, *command.a_WS_W)


def _breach(examined: Iterable[tuple[str, _Checks]]) -> str:
    """Describe the first check that does not hold, with its axis; empty when all hold."""
    breaches = (
        f"{name}{what} {value:.12g}, allowed: {low:.12g} <= value <= {high:.12g}"
        for name, checks in examined
        for what, value, low, high in checks
        if not low <= value <= high
    )
    return next(breaches, "")
