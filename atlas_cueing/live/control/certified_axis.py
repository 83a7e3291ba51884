"""One axis of wheels or stage: what may follow a state, and the stop that is always left.

The guard examines every command by it, and the drives' side every set point: see `guard` for the
inequalities. `CertifiedStop` is what both fly when there is nothing else to fly.
"""

# mypyc: runs every tick

from math import copysign, inf, isinf, sqrt, ulp

from ...errors import InputError
from ...rotation import Vec3
from ...signals import StageLimits, WheelLimits

# share by which a limit may be passed, as differences of rounded numbers do; the stop has it, too
ROUNDING = 5e-7


def outside(name: str, what: str, value: float, low: float, high: float) -> str:
    """Describe a value of an axis that is not inside its bounds; empty when it is."""
    if low <= value <= high:
        return ""
    return f"{name}{what} {value:.12g}, allowed: {low:.12g} <= value <= {high:.12g}"


class AxisLimits:
    """Limits of one axis, with room for rounding; the travel of a wheel is infinite.

    Between two ticks a motion leaves the line between its ends by A h^2 / 8 at most: so much of the
    travel is not used.
    """

    def __init__(
        self,
        name: str,
        dt: float,
        speed: float,
        acceleration: float,
        jerk: float,
        travel: float = inf,
        stop_share: float = 1.0,
    ) -> None:
        """Set up the limits (m or rad, s) of the axis `name`, for ticks of dt (s).

        stop_share: of the acceleration, that its stop brakes with; below 1 it is soft.

        Raises InputError for a tick or a limit that is not positive, or no travel between ticks.
        """
        named = (("tick", dt), ("speed", speed), ("acceleration", acceleration), ("jerk", jerk))
        for what, value in named:
            if not 0.0 < value < inf:
                raise InputError(f"{name}{what} {value:g}, allowed: 0 < value < inf")
        self.name = name
        self.speed, self.acceleration, self.jerk = (
            x * (1.0 + ROUNDING) for x in (speed, acceleration, jerk)
        )
        self.soft, self._braking = stop_share < 1.0, stop_share * self.acceleration
        # for J in speed and position: rounding there, and h - |D| / J > 0
        self.reach = self.jerk * (1.0 + ROUNDING)
        self.travel = travel
        if not isinf(travel):
            self.travel = travel * (1.0 + ROUNDING) - acceleration * dt * dt / 8.0

    def breach(
        self, h: float, p0: float, v0: float, a0: float, p: float, v: float, a: float
    ) -> str:
        """Describe what of p, v, a is not fit to follow p0, v0, a0 by h (s); empty when all is."""
        return self._rate_breach(h, v0, a0, v, a) or self._place_breach(h, p0, v0, a0, p, v, a)

    def _rate_breach(self, h: float, v0: float, a0: float, v: float, a: float) -> str:
        """Look at speed and acceleration."""
        name, fast, strong = self.name, self.speed, self.acceleration
        turn, gain, D = self.jerk * h, strong * h, a - a0
        mean, bend = v0 + 0.5 * h * (a0 + a), 0.25 * (self.reach * h * h - D * D / self.reach)
        rest = v + 0.5 * a * abs(a) / self.jerk
        return (
            outside(name, "speed", v, -fast, fast)
            or outside(name, "acceleration", a, -strong, strong)
            or outside(name, "acceleration by the jerk", a, a0 - turn, a0 + turn)
            or outside(name, "speed by the acceleration", v, v0 - gain, v0 + gain)
            or outside(name, "speed by the jerk", v, mean - bend, mean + bend)
            or outside(name, "speed on the way to standstill", rest, -fast, fast)
        )

    def _place_breach(
        self, h: float, p0: float, v0: float, a0: float, p: float, v: float, a: float
    ) -> str:
        """Look at the position, v and a being fit."""
        if isinf(self.travel):
            return self._way_breach(h, p0, v0, a0, p, v, a, abs(p0) + self.speed * h)
        name, end, stop = self.name, self.travel, self.stop(p, v, a)
        return (
            outside(name, "position", p, -end, end)
            or self._way_breach(h, p0, v0, a0, p, v, a, end)
            or outside(name, "standstill", stop.end, -end, end)
            or outside(name, "turning point", stop.turning_point, -end, end)
        )

    def _way_breach(
        self,
        h: float,
        p0: float,
        v0: float,
        a0: float,
        p: float,
        v: float,
        a: float,
        largest: float,
    ) -> str:
        """Look at the way from p0 to p; `largest` is the largest number that was rounded."""
        name, blur = self.name, 4.0 * ulp(largest)
        way, sag = self.speed * h + blur, 0.5 * self.acceleration * h * h + blur
        old, new = p0 + h * v0, p0 + h * v
        low, high = self.reachable(h, p0, v0, a0, v, a)
        return (
            outside(name, "position by the speed", p, p0 - way, p0 + way)
            or outside(name, "position by the acceleration", p, old - sag, old + sag)
            or outside(name, "position by the acceleration", p, new - sag, new + sag)
            or outside(name, "position by the jerk", p, low - blur, high + blur)
        )

    def reachable(
        self, h: float, p0: float, v0: float, a0: float, v: float, a: float
    ) -> tuple[float, float]:
        """Return the lowest and the highest p to which h s of limited jerk can lead."""
        D = a - a0
        m = 0.5 * h * (a0 + a) - (v - v0)
        c, skew = p0 + 0.5 * h * (v0 + v) - h * h * D / 8.0, D / self.reach
        return (
            c - 0.5 * self._moment(h, m, h + skew),
            c + 0.5 * self._moment(h, m, h - skew),
        )

    def stop(self, p: float, v: float, a: float, share: float = 1.0) -> "CertifiedStop":
        """Return the stop from position p, speed v and acceleration a: the shortest, or soft.

        share: of the jerk, that it takes.
        """
        jerk = share * self.jerk
        if self.soft:
            return SoftStop(p, v, a, self._braking, jerk)
        return CertifiedStop(p, v, a, self.acceleration, jerk)

    def _moment(self, h: float, m: float, d: float) -> float:
        """Return f(d) of the guard's text."""
        return self.reach * (h * h * h / 12.0 - d * d * d / 48.0) - m * m / (self.reach * d)


def six_axes(dt: float, wheels: WheelLimits, stage: StageLimits) -> list[AxisLimits]:
    """Return the limits of wheels 1 to 3 and of the stage's x, y, z, for ticks of dt (s).

    Raises InputError for limits that are not positive.
    """
    turns = zip("123", wheels.speed, wheels.acceleration, wheels.jerk, strict=True)
    rails = zip("xyz", stage.speed, stage.acceleration, stage.jerk, stage.travel, strict=True)
    return [
        *(
            AxisLimits(f"wheel {name} ", dt, v, a, j, inf, wheels.stop_share)
            for name, v, a, j in turns
        ),
        *(
            AxisLimits(f"stage {name} ", dt, v, a, j, travel, stage.stop_share)
            for name, v, a, j, travel in rails
        ),
    ]


class CertifiedStop:
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

    @property
    def duration(self) -> float:
        """Time until it stands, s."""
        return max(2.0 * self._ramp + self._hold - self._since, 0.0)

    def at(self, t: float) -> Vec3:
        """Return position, speed and acceleration t >= 0 s after its start.

        They are integrated backwards from the end: every sum is one of products. From `duration` on
        it stands, to the last bit.
        """
        if t >= self.duration:
            return self.end, 0.0, 0.0
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


class SoftStop(CertifiedStop):
    """A stop that brakes with less than an axis may: one that brakes harder lets go to it first.

    Letting go from |a| to the stop's own acceleration A takes (|a| - A) / J at the jerk J, and does
    not turn the axis round; then it goes on as a `CertifiedStop` that begins braking with A.
    """

    def __init__(self, p: float, v: float, a: float, acceleration: float, jerk: float) -> None:
        sign = copysign(1.0, v + 0.5 * a * abs(a) / jerk)
        t = max((-sign * a - acceleration) / jerk, 0.0)
        self._begin, self._letting, self._turn = (p, v, a), t, sign * jerk
        if t > 0.0:
            p = p + t * (v + t * (0.5 * a + t * self._turn / 6.0))
            v, a = v + t * (a + 0.5 * t * self._turn), -sign * acceleration
        super().__init__(p, v, a, acceleration, jerk)
        if t > 0.0:
            self.turning_point = self._begin[0]

    @property
    def duration(self) -> float:
        """Time until it stands, s."""
        return self._letting + max(2.0 * self._ramp + self._hold - self._since, 0.0)

    def at(self, t: float) -> Vec3:
        """Return position, speed and acceleration t >= 0 s after its start."""
        if t >= self._letting:
            return super().at(t - self._letting)
        p, v, a = self._begin
        j = self._turn
        return p + t * (v + t * (0.5 * a + t * j / 6.0)), v + t * (a + 0.5 * t * j), a + t * j
