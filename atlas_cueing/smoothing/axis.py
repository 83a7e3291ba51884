"""One jerk-limited axis: it meets a target within reach, and nears any other the shortest way.

Within a time T, two halves of constant jerk lead from (v, a) to any (v1, a1):

    a1 - a = (j1 + j2) T / 2        v1 - v - a T = (3 j1 + j2) T^2 / 8

If both stay within the jerk limit, and the acceleration between them within its own, with one tick
for T, that step is flown: it has the least peak jerk, and a feasible cue passes unchanged. If they
do with a few ticks, h each, for T and two thirds of the jerk, towards v1 + a1 (T - h), where the
target is by then, the first of these ticks is flown. Otherwise ruckig plans the way of least time
    (velocity interface; Berscheid & Kroeger, RSS 2021),
which has full jerk to its end: a target that moves other than a1 says would be crossed tick by
tick, the jerk going from limit to limit.

Traps of ruckig 0.19 closed here: non-finite numbers and short lists reach its C++ unchecked, so
they are refused before the call; an error leaves old values in its output, so a call returns a
fresh state or raises; `update` goes on along the old plan when the input repeats itself, so every
step is a fresh `calculate`; positions are re-based to zero at every step, so an angle may grow for
ever; the velocity interface passes the speed limit on its way to an infeasible target, so targets
are clipped first. `intermediate_positions`, which would call a cloud service, is never set.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import isfinite, sqrt
from typing import Final

from ruckig import ControlInterface, InputParameter, Result, Ruckig, RuckigError, Trajectory

from ..errors import PlanningError
from .stop import Stop

# share of each limit left unused, so that finite differences of what is flown stay inside it
_ROUNDING = 1e-9
_EASED = (2, 3, 4, 6, 8, 12, 16, 24)  # ticks in which a near target may be met
_EASING = 0.0251  # s, the longest of them (assumed; 25 ms is 3 ticks of 120 Hz)
# of the jerk, to meet it with: with all of it, noise of a cue would turn the jerk round (assumed)
_EASED_SHARE = 2.0 / 3.0


@dataclass(slots=True, init=False)
class Step:
    """Where one tick leads: displacement, speed v, acceleration a, and if the target was met."""

    displacement: Final[float]
    v: Final[float]
    a: Final[float]
    met: Final[bool]

    def __init__(self, displacement: float, v: float, a: float, met: bool) -> None:
        self.displacement = displacement
        self.v = v
        self.a = a
        self.met = met


class AxisSmoothing:
    """Tracking of a speed and acceleration inside the limits, one tick at a time."""

    def __init__(
        self,
        dt: float,
        speed: float,
        acceleration: float,
        jerk: float,
        stop_share: float = 1.0,
    ) -> None:
        """Limits are magnitudes; dt in s; stop_share: of the acceleration, below 1 for soft stops.

        Raises ValueError for limits that are not positive or leave no room between ticks.

        Between ticks the speed stays within J dt^2 / 8 of the line between its ends, so that much
        of it is left unused.
        """
        bend = jerk * dt * dt / 8.0
        if not all(isfinite(x) and x > 0.0 for x in (dt, speed - bend, acceleration, jerk)):
            raise ValueError(
                f"0 < dt, acceleration, jerk and jerk dt^2 / 8 < speed; got {dt}, {acceleration},"
                f" {jerk}, {speed}"
            )
        self.dt = dt
        self.speed, self.acceleration, self.jerk = (
            (1.0 - _ROUNDING) * x for x in (speed - bend, acceleration, jerk)
        )
        self._soft = stop_share < 1.0
        self.stop_acceleration = stop_share * self.acceleration
        self._times = [k * dt for k in _EASED if k * dt <= _EASING]
        # below it every acceleration is fine
        self._cruise = self.speed - 0.5 * self.acceleration**2 / self.jerk
        self._generator, self._input, self._trajectory = (
            Ruckig(1, dt),
            InputParameter(1),
            Trajectory(1),
        )
        self._input.control_interface = ControlInterface.Velocity
        self._input.current_position = [0.0]
        self._input.max_velocity, self._input.max_acceleration = [self.speed], [self.acceleration]
        self._input.max_jerk = [self.jerk]
        # a target may be met at the tick, not before it and drifted past
        self._input.minimum_duration = dt

    def clip(self, v: float, a: float) -> tuple[float, float]:
        """Give the nearest target from which the axis can stay inside its speed limit.

        That holds before and after it: |v| + a^2 / 2J <= V.
        """
        if -self._cruise < v < self._cruise and -self.acceleration <= a <= self.acceleration:
            return v, a
        v = min(max(v, -self.speed), self.speed)
        a_max = min(self.acceleration, sqrt(2.0 * self.jerk * (self.speed - abs(v))))
        return v, min(max(a, -a_max), a_max)

    def towards(self, v: float, a: float, v_target: float, a_target: float) -> Step:
        """Give the step from (v, a) on the way to the clipped target. Raises PlanningError."""
        v1, a1 = self.clip(v_target, a_target)
        return self._reach(v, a, v1, a1) or self._eased(v, a, v1, a1) or self._plan(v, a, v1, a1)

    def stopping(self, v: float, a: float) -> Step:
        """Give the step from (v, a) into the closed-form stop; it needs no generator."""
        displacement, v, a = self.stop(v, a).at(self.dt)
        return Step(displacement, v, a, False)

    def stop(self, v: float, a: float) -> Stop:
        """Give the certified stop from (v, a): the shortest one, or the soft one."""
        if self._soft:
            return Stop.soft(v, a, self.stop_acceleration, self.jerk)
        return Stop.plan(v, a, self.stop_acceleration, self.jerk)

    def range_at(self, a0: float, v0: float) -> tuple[float, float]:
        """Give the accelerations that one constant jerk may lead to from (v0, a0) in a tick.

        Jerk, acceleration, and the speed that is left when the acceleration is brought to zero:
        v0 + h (a0 + a) / 2 + a |a| / 2J within +-V.
        """
        h, mean = self.dt, v0 + 0.5 * self.dt * a0
        turn = self.jerk * h
        most = self._until_speed(self.speed - mean)
        least = -self._until_speed(self.speed + mean)
        return (
            max(a0 - turn, -self.acceleration, least),
            min(a0 + turn, self.acceleration, most),
        )

    def _until_speed(self, room: float) -> float:
        """Give the a with h a / 2 + a |a| / 2J = room."""
        half = 0.5 * self.dt
        root = self.jerk * (sqrt(half * half + 2.0 * abs(room) / self.jerk) - half)
        return root if room >= 0.0 else -root

    def _reach(self, v: float, a: float, v1: float, a1: float) -> Step | None:
        """Give the step of two halves to (v1, a1), if it is inside the limits."""
        h = self.dt
        gained, missing = (a1 - a) / h, 4.0 * (v1 - v - a * h) / (h * h)
        j1, j2 = missing - gained, 3.0 * gained - missing
        if not self._have(self.jerk, j1, j2, a + 0.5 * j1 * h):
            return None
        return Step(h * (v + h * (0.5 * a + h * (7.0 * j1 + j2) / 48.0)), v1, a1, True)

    def _eased(self, v: float, a: float, v1: float, a1: float) -> Step | None:
        """Give the first tick of two halves that meet the target in few ticks, if any do."""
        h, gentle = self.dt, _EASED_SHARE * self.jerk
        for time in self._times:
            gained, missing = (a1 - a) / time, 4.0 * ((v1 - v - a * time) + a1 * (time - h))
            j1 = missing / (time * time) - gained
            if self._have(gentle, j1, 2.0 * gained - j1, a + 0.5 * j1 * time):
                a2, v2 = a + j1 * h, v + h * (a + 0.5 * j1 * h)
                if not max(abs(v2), abs(v2 + a2 * abs(a2) / (2.0 * self.jerk))) <= self.speed:
                    return None
                return Step(h * (v + h * (0.5 * a + h * j1 / 6.0)), v2, a2, False)
        return None

    def _have(self, jerk: float, j1: float, j2: float, between: float) -> bool:
        """Whether two halves keep this jerk, and the acceleration between them its limit."""
        return (
            -jerk <= j1 <= jerk
            and -jerk <= j2 <= jerk
            and -self.acceleration <= between <= self.acceleration
        )

    def _plan(self, v: float, a: float, v1: float, a1: float) -> Step:
        """Give the step along ruckig's trajectory to (v1, a1), checked."""
        if not isfinite(v + a + v1 + a1):
            raise PlanningError(f"not finite: from ({v}, {a}) to ({v1}, {a1})")
        self._input.current_velocity, self._input.current_acceleration = [v], [a]
        self._input.target_velocity, self._input.target_acceleration = [v1], [a1]
        try:
            result = self._generator.calculate(self._input, self._trajectory)
        except (RuckigError, ValueError) as error:
            raise PlanningError(str(error).strip()) from error
        if result not in (Result.Working, Result.Finished):
            raise PlanningError(f"ruckig says {result}")
        (p,), (v_next,), (a_next,) = self._trajectory.at_time(self.dt)
        return self._checked(
            v, a, Step(p, v_next, a_next, self._trajectory.duration <= self.dt * (1.0 + 1e-9))
        )

    def _checked(self, v: float, a: float, step: Step) -> Step:
        """Give the step, if a jerk-limited motion leads to it and on inside the speed limit.

        Raises PlanningError otherwise.

        Around the straight line between its ends the acceleration can bend by at most J dt / 2,
        worth J dt^2 / 4 of speed; bringing it to zero afterwards takes a|a| / 2J of speed.
        """
        slack = 1.0 + 0.5 * _ROUNDING
        bend = 0.25 * self.jerk * self.dt * self.dt
        if not (
            isfinite(step.displacement)
            and abs(step.v - v - 0.5 * self.dt * (a + step.a))
            <= bend * (1.0 + 1e-6) + 1e-12 * self.speed
            and abs(step.a) <= self.acceleration * slack
            and abs(step.a - a) <= self.jerk * self.dt * slack
            and max(abs(step.v), abs(step.v + step.a * abs(step.a) / (2.0 * self.jerk)))
            <= self.speed * slack
        ):
            raise PlanningError(
                f"a step outside the limits: from ({v}, {a}) to ({step.v}, {step.a})"
            )
        return step
