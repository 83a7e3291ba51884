"""One axis of ruckig, typed and fenced: the only place that talks to the trajectory generator.

Traps closed here (all seen in ruckig 0.19): non-finite numbers and short lists reach its C++ unchecked, so both are refused
before the call; an error leaves old values in its output, so a call either returns a fresh state or raises; `update` goes on
along the old plan when the input repeats itself, so every step is a fresh `calculate`; positions are re-based to zero at
every step, so an angle may grow for ever; the velocity interface may pass the speed limit on its way to an infeasible
target, so targets are clipped first. `intermediate_positions`, which would call a cloud service, is never set.
"""

from dataclasses import dataclass
from math import isfinite, sqrt

from ruckig import ControlInterface, InputParameter, Result, Ruckig, RuckigError, Trajectory

from ..errors import PlanningError
from .stop import Stop, reachable_speed

_ROUNDING = 1e-9  # share of each limit left unused, so that finite differences of what is flown stay inside it


@dataclass(frozen=True, slots=True)
class Step:
    """Where one tick leads: displacement, speed, acceleration, and whether the target was met at its end."""

    displacement: float
    v: float
    a: float
    met: bool


class Axis:
    """Jerk-limited tracking of a speed and acceleration, one tick at a time."""

    def __init__(self, dt: float, speed: float, acceleration: float, jerk: float) -> None:
        """Limits are magnitudes; dt in s. Raises ValueError unless all are finite and positive."""
        if not all(isfinite(x) and x > 0.0 for x in (dt, speed, acceleration, jerk)):
            raise ValueError(f"0 < dt, speed, acceleration, jerk < inf; got {dt}, {speed}, {acceleration}, {jerk}")
        self.dt = dt
        self.speed, self.acceleration, self.jerk = ((1.0 - _ROUNDING) * x for x in (speed, acceleration, jerk))
        self._generator, self._input, self._trajectory = Ruckig(1, dt), InputParameter(1), Trajectory(1)
        self._input.control_interface = ControlInterface.Velocity
        self._input.current_position = [0.0]
        self._input.max_velocity, self._input.max_acceleration = [self.speed], [self.acceleration]
        self._input.max_jerk = [self.jerk]
        self._input.minimum_duration = dt  # a target within reach is met at the tick, not before it and drifted past

    def clip(self, v: float, a: float) -> tuple[float, float]:
        """Nearest target from which the axis can stay inside its speed limit, before and after: |v| + a^2 / 2J <= V."""
        v = min(max(v, -self.speed), self.speed)
        a_max = min(self.acceleration, sqrt(2.0 * self.jerk * (self.speed - abs(v))))
        return v, min(max(a, -a_max), a_max)

    def towards(self, v: float, a: float, v_target: float, a_target: float) -> Step:
        """State one tick after (v, a) on the shortest way to the clipped target. Raises PlanningError."""
        v_clipped, a_clipped = self.clip(v_target, a_target)
        if not isfinite(v + a + v_clipped + a_clipped):
            raise PlanningError(f"not finite: from ({v}, {a}) to ({v_target}, {a_target})")
        step = self._step(v, a, v_clipped, a_clipped)
        if not self._is_fair(v, a, step):
            raise PlanningError(f"a step outside the limits: from ({v}, {a}) to ({step.v}, {step.a})")
        return step

    def stopping(self, v: float, a: float) -> Step:
        """State one tick into the closed-form stop from (v, a); needs no generator."""
        return Step(*Stop.plan(v, a, self.acceleration, self.jerk).at(self.dt), False)

    def _step(self, v: float, a: float, v_target: float, a_target: float) -> Step:
        self._input.current_velocity, self._input.current_acceleration = [v], [a]
        self._input.target_velocity, self._input.target_acceleration = [v_target], [a_target]
        try:
            result = self._generator.calculate(self._input, self._trajectory)
        except (RuckigError, ValueError) as error:
            raise PlanningError(str(error).strip()) from error
        if result not in (Result.Working, Result.Finished):
            raise PlanningError(f"ruckig says {result}")
        ((p,), (v1,), (a1,)) = self._trajectory.at_time(self.dt)
        return Step(p, v1, a1, self._trajectory.duration <= self.dt * (1.0 + 1e-9))

    def _is_fair(self, v: float, a: float, step: Step) -> bool:
        """Whether a jerk-limited motion leads from (v, a) to the step and on inside the speed limit.

        Around the straight line between its ends the acceleration can bend by at most J dt / 2, worth J dt^2 / 4 of speed.
        """
        bend = 0.25 * self.jerk * self.dt * self.dt
        off = abs(step.v - v - 0.5 * self.dt * (a + step.a))
        return (
            isfinite(step.displacement)
            and off <= bend * (1.0 + 1e-6) + 1e-12 * self.speed
            and abs(step.a) <= self.acceleration * (1.0 + 0.5 * _ROUNDING)
            and abs(step.a - a) <= self.jerk * self.dt * (1.0 + 0.5 * _ROUNDING)
            and reachable_speed(step.v, step.a, self.jerk) <= self.speed * (1.0 + 0.5 * _ROUNDING)
        )
