"""The shortest jerk-limited stop, in closed form: the certificate behind every step.

One axis with acceleration bound A and jerk bound J, at speed v and acceleration a. Let u = v + a|a|
/ 2J be the speed that would be left if the acceleration were brought to zero at once, and s its
sign. The time-optimal way to v = a = 0 has three phases of constant jerk, -sJ, 0, sJ, with peak
deceleration

    A' = min(A, sqrt(s J v + a^2 / 2))

since the first phase changes the speed by (a^2 - A'^2) / 2J and the last by A'^2 / 2J; what is left
takes the middle phase. On its way the stop only ever meets states whose own stop is the rest of the
same stop: a certified state therefore always has a certified successor. Phases as in L. Berscheid &
T. Kroeger, "Jerk-limited Real-time Trajectory Generation with Arbitrary Target States", RSS 2021,
velocity interface with target zero.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import sqrt


@dataclass(frozen=True, slots=True)
class Stop:
    """Stop from (v, a) in phases of (jerk, duration).

    Displacements are relative to its start, m or rad.
    """

    v: float
    a: float
    phases: tuple[tuple[float, float], ...]

    @classmethod
    def plan(cls, v: float, a: float, a_max: float, j_max: float) -> "Stop":
        """Plan the stop from speed v and acceleration a, |a| <= a_max, with jerk at most j_max."""
        s = 1.0 if v + a * abs(a) / (2.0 * j_max) >= 0.0 else -1.0
        v_s, a_s = s * v, s * a  # mirrored, so that the stop brakes downwards
        peak = min(a_max, sqrt(max(j_max * v_s + 0.5 * a_s * a_s, 0.0)))
        hold = (v_s + (0.5 * a_s * a_s - peak * peak) / j_max) / peak if peak > 0.0 else 0.0
        jerk = s * j_max
        return cls(
            v,
            a,
            ((-jerk, max(a_s + peak, 0.0) / j_max), (0.0, max(hold, 0.0)), (jerk, peak / j_max)),
        )

    @classmethod
    def soft(cls, v: float, a: float, a_soft: float, j_max: float) -> "Stop":
        """Plan the stop that brakes with a_soft only; an axis that brakes harder lets go first.

        Letting go from |a| > a_soft keeps u, the speed left, which the hold at a_soft then takes in
        u / a_soft. As with `plan`, what is left of it is the soft stop of every state on it.
        """
        s = 1.0 if v + a * abs(a) / (2.0 * j_max) >= 0.0 else -1.0
        harder = -s * a - a_soft
        if harder <= 0.0:
            return cls.plan(v, a, a_soft, j_max)
        jerk, left = s * j_max, abs(v + a * abs(a) / (2.0 * j_max))
        return cls(
            v,
            a,
            # it cannot turn round, so its first phase has no jerk, and no time (see `span`)
            ((0.0, 0.0), (jerk, harder / j_max), (0.0, left / a_soft), (jerk, a_soft / j_max)),
        )

    @property
    def duration(self) -> float:
        """Time until standstill, s."""
        return sum(duration for _, duration in self.phases)

    def at(self, t: float) -> tuple[float, float, float]:
        """Displacement, speed and acceleration at time t >= 0 into the stop.

        At rest from its end on.
        """
        p, v, a = 0.0, self.v, self.a
        for jerk, duration in self.phases:
            step = min(t, duration)
            p, v, a = _coast(p, v, a, jerk, step)
            t -= step
            if t <= 0.0:
                return p, v, a
        return p, 0.0, 0.0

    def bounds_from(self, t: float) -> tuple[float, float, float]:
        """Lowest and highest acceleration, and largest speed either way, from time t on.

        The acceleration is piecewise linear and ends at zero. The speed falls from t on, or from
        where the acceleration has come to zero.
        """
        _, v, a = self.at(t)
        low, high, begin, acceleration = min(a, 0.0), max(a, 0.0), 0.0, self.a
        fastest = abs(v)
        for jerk, duration in self.phases:
            begin += duration
            acceleration += jerk * duration
            if jerk != 0.0:
                fastest = max(fastest, abs(v + 0.5 * a * abs(a) / abs(jerk)))
            if begin >= t:
                low, high = min(low, acceleration), max(high, acceleration)
        return low, high, fastest

    def span(self) -> tuple[float, float]:
        """Lowest and highest displacement on the way.

        At the start, at the end and where the speed changes its sign.

        It does so at most once, in the first phase, when the acceleration is about to carry the
        axis backwards.
        """
        end = self.at(self.duration)[0]
        jerk = self.phases[0][0]
        if self.v * jerk <= 0.0:
            return min(0.0, end), max(0.0, end)
        under = max(self.a * self.a - 2.0 * jerk * self.v, 0.0)
        # the earlier root of v + a t + jerk t^2 / 2
        turn = 2.0 * abs(self.v) / (abs(self.a) + sqrt(under))
        at_turn = _coast(0.0, self.v, self.a, jerk, turn)[0]
        return min(0.0, end, at_turn), max(0.0, end, at_turn)


def stop_bound(v: float, a: float, a_max: float, j_max: float) -> float:
    """Give a distance that no stop from (v, a) exceeds to either side.

    It is a cheap bound that settles most certificates. Bringing a to zero takes |a| / J at no more
    than u = |v| + a^2 / 2J; from a = 0 a stop takes u sqrt(u / J) or u/2 (u / A + A / J), and the
    latter is never less.
    """
    u = abs(v) + a * a / (2.0 * j_max)
    return u * (abs(a) / j_max + 0.5 * (u / a_max + a_max / j_max))


def approach(distance: float, gain: float, a_max: float, j_max: float) -> tuple[float, float]:
    """Give the speed at which to close a distance d >= 0 so as to stop at its end, and its slope.

    The slope is over d, 1/s. The speed is the least of three, so that no deceleration (speed times
    slope) goes beyond a_max: gain d; from d = A / gain^2 on, with the same slope there,
    sqrt(2 A (d - A / 2 gain^2)); and the speed from which the jerk-limited stop from a = 0 takes d,
    d = v sqrt(v / J) below v = A^2 / J and d = v/2 (v / A + A / J) above.
    """
    if distance * gain * gain <= a_max and distance * gain * gain * gain <= j_max:
        return gain * max(distance, 0.0), gain
    return min(_by_acceleration(distance, gain, a_max), _by_jerk(distance, a_max, j_max))


def _by_acceleration(distance: float, gain: float, a_max: float) -> tuple[float, float]:
    if distance * gain * gain <= a_max:
        return gain * distance, gain
    speed = sqrt(2.0 * a_max * (distance - 0.5 * a_max / (gain * gain)))
    return speed, a_max / speed


def _by_jerk(distance: float, a_max: float, j_max: float) -> tuple[float, float]:
    if distance * j_max * j_max < a_max * a_max * a_max:
        speed = (distance * distance * j_max) ** (1.0 / 3.0)
        return speed, 2.0 * speed / (3.0 * distance)
    half = 0.5 * a_max * a_max / j_max
    root = sqrt(half * half + 2.0 * a_max * distance)
    return root - half, a_max / root


def _coast(p: float, v: float, a: float, jerk: float, t: float) -> tuple[float, float, float]:
    """Give displacement, speed and acceleration after t seconds of constant jerk."""
    return p + t * (v + t * (0.5 * a + t * jerk / 6.0)), v + t * (a + 0.5 * t * jerk), a + t * jerk
