"""The stage inside its rails, for ever.

Each axis of W follows its cue with the speed v_cue + g(e), the acceleration a_cue - g'(e) g(e), e =
x_cue - x, and a speed towards either end of the travel from which it can stop in time. That makes
for a good ride; what makes it safe is the certificate: a step is flown only if the jerk-limited
stop from where it leads stays inside the travel, and otherwise the stop that was certified a tick
ago is flown, whose every later state is certified as well (`stop`).

Between ticks a step stays within A dt^2 / 8 of the line between its ends, so that much of the
travel is left unused; the stop itself is checked in continuous time.
"""

# mypyc: runs every tick

from math import copysign, inf, isfinite
from typing import Final

from ..errors import PlanningError
from ..rotation import Vec3
from ..signals import Cue, StageLimits
from .axis import AxisSmoothing, Step
from .stop import Stop, approach, stop_bound

_GAIN: Final = 4.0  # 1/s; a small position error is taken back with a time constant of 0.25 s
# 1/s; over the last centimetres of the travel the speed falls with a time constant of 0.1 s
_END_GAIN: Final = 10.0
# of acceleration and jerk, planned with towards the ends of the travel and a distant cue
_BRAKING_SHARE: Final = 0.7
_MET_DISTANCE: Final = 1e-4  # m; a larger lag than this is reported as limited


class RailAxis:
    """One axis of the stage: position, speed and acceleration, one tick at a time."""

    def __init__(
        self,
        dt: float,
        travel: float,
        speed: float,
        acceleration: float,
        jerk: float,
        stop_share: float = 1.0,
    ) -> None:
        """Start at rest in the centre; stop_share as for `AxisSmoothing`.

        Raises ValueError for limits that leave no room to move between two ticks.
        """
        self._axis = AxisSmoothing(dt, speed, acceleration, jerk, stop_share)
        self.travel = travel - acceleration * dt * dt / 8.0
        if not self.travel > 0.0:
            raise ValueError(
                f"travel > acceleration dt^2 / 8 = {acceleration * dt * dt / 8.0:.3g} m; got"
                f" {travel} m"
            )
        self._braking, self._braking_jerk = (
            _BRAKING_SHARE * self._axis.stop_acceleration,
            _BRAKING_SHARE * self._axis.jerk,
        )
        self.p = self.v = self.a = 0.0

    def start(self, p: float) -> None:
        """Begin at rest in p (m), or where the travel ends."""
        self.p = min(max(p, -self.travel), self.travel) if isfinite(p) else 0.0
        self.v = self.a = 0.0

    def step(self, p: float, v: float, a: float) -> bool:
        """Follow a cue for one tick; return whether it was given. Any input is safe."""
        step, near = self.wanted(p, v, a)
        self.fly(step)
        return step.met and near

    def wanted(self, p: float, v: float, a: float) -> tuple[Step, bool]:
        """Give the certified step towards a cue, and whether it is near the cue."""
        to_go = p - (self.p + 0.5 * self._axis.dt * (self.v + v))
        try:
            v_target, a_target = self._demand(to_go, v, a)
            step = self._axis.towards(self.v, self.a, v_target, a_target)
            if not self.is_certified(step):
                step = self.stopping()
        except PlanningError:
            step = self.stopping()
        return step, abs(to_go) <= _MET_DISTANCE

    def stopping(self) -> Step:
        """Give the step into the certified stop."""
        return self._axis.stopping(self.v, self.a)

    def stop(self, step: Step) -> Stop:
        """Give the certified stop from where a step leads."""
        return self._axis.stop(step.v, step.a)

    def fly(self, step: Step) -> None:
        """Take a step."""
        self.p, self.v, self.a = self.p + step.displacement, step.v, step.a

    def _demand(self, to_go: float, v: float, a: float) -> tuple[float, float]:
        """Give speed and acceleration asked for at the end of the tick."""
        if not -inf < to_go + v + a < inf:
            return 0.0, 0.0
        closing, slope = approach(abs(to_go), _GAIN, self._braking, self._braking_jerk)
        closing = copysign(closing, to_go)
        v_target, a_target = (
            min(max(v + closing, -self._axis.speed), self._axis.speed),
            a - slope * closing,
        )
        ahead = self.p + 0.5 * self._axis.dt * (self.v + v_target)
        room = self.travel - (ahead if v_target > 0.0 else -ahead)
        fastest, slope = approach(room, _END_GAIN, self._braking, self._braking_jerk)
        if -fastest <= v_target <= fastest:
            return v_target, a_target
        return copysign(fastest, v_target), -slope * copysign(fastest, v_target)

    def is_certified(self, step: Step) -> bool:
        """Whether the stop from where the step leads stays inside the travel."""
        p = self.p + step.displacement
        if (
            abs(p) + stop_bound(step.v, step.a, self._axis.stop_acceleration, self._axis.jerk)
            <= self.travel
        ):
            return True
        low, high = self._axis.stop(step.v, step.a).span()
        return -self.travel <= p + low and p + high <= self.travel


class StageSmoothing:
    """Position, velocity and acceleration of the stage (W) tick by tick, inside its limits."""

    def __init__(self, dt: float, limits: StageLimits) -> None:
        """Start at rest in the centre; dt in s."""
        x, y, z = zip(limits.travel, limits.speed, limits.acceleration, limits.jerk, strict=True)
        self._axes = (
            RailAxis(dt, *x, limits.stop_share),
            RailAxis(dt, *y, limits.stop_share),
            RailAxis(dt, *z, limits.stop_share),
        )

    @property
    def axes(self) -> tuple[RailAxis, RailAxis, RailAxis]:
        """The axes x, y, z of W."""
        return self._axes

    def start(self, cue: Cue) -> None:
        """Begin at rest in the cue's position, as far as it lies in the travel."""
        for axis, p in zip(self._axes, cue.p_WS_W, strict=True):
            axis.start(p)

    def step(self, cue: Cue) -> bool:
        """Follow the cue for one tick; return whether all of it was given. Any cue is safe."""
        axes, p, v, a = self._axes, cue.p_WS_W, cue.v_WS_W, cue.a_WS_W
        met_x = axes[0].step(p[0], v[0], a[0])
        met_y = axes[1].step(p[1], v[1], a[1])
        met_z = axes[2].step(p[2], v[2], a[2])
        return met_x and met_y and met_z

    @property
    def p_WS_W(self) -> Vec3:
        """Position of the sphere centre, m, in W."""
        x, y, z = self._axes
        return (x.p, y.p, z.p)

    @property
    def v_WS_W(self) -> Vec3:
        """Velocity of the sphere centre, m/s, in W."""
        x, y, z = self._axes
        return (x.v, y.v, z.v)

    @property
    def a_WS_W(self) -> Vec3:
        """Acceleration of the sphere centre, m/s^2, in W."""
        x, y, z = self._axes
        return (x.a, y.a, z.a)
