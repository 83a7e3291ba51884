"""Rotation smoothed in wheel space, where its limits are.

With e = log(q_cue q^-1) the turn still to go (rotation vector in W, |e| its geodesic length) and n
its direction, the sphere is asked for

    Omega = Omega_cue + g(|e|) n      alpha = alpha_cue - g'(|e|) g(|e|) n + g(|e|) Omega_cue x n

so that |e|' = -g(|e|) and n turns with the cue, n' = Omega_cue x n. The closing speed g is gain |e|
near the cue, and far from it the speed from which the wheels can still brake to a stop on the cue.
J^-1 (paper, Eq. 22, and Eq. 19 for alpha) turns both into targets of the three wheels, each of
which keeps its own speed, acceleration and jerk. The turn each wheel really makes goes back through
J and Eq. 20 into the orientation.
"""

# mypyc: runs every tick

from math import inf, pi
from typing import Final

from ..rotation import (
    IDENTITY,
    ZERO,
    Mat3,
    Vec3,
    add,
    apply,
    continuous,
    cross,
    difference,
    integrate_base,
    log_unwound,
    norm,
    normalise,
    scale,
    subtract,
)
from ..signals import Cue, WheelLimits
from .axis import AxisSmoothing, Step
from .stop import approach

_GAIN: Final = 4.0  # 1/s; a small orientation error is taken back with a time constant of 0.25 s
# of the wheels' acceleration and jerk, planned with on the way to a distant cue
_BRAKING_SHARE: Final = 0.5
_MET_ANGLE: Final = 0.01 * pi / 180.0  # rad; a larger lag than this is reported as limited
_NO_ANGLE: Final = 1e-12  # rad; a smaller error has no direction worth the name
# rad beyond half a turn before a catch-up under way changes over to the other way round
_OTHER_WAY: Final = 0.5


class SphereSmoothing:
    """Orientation, rate and acceleration of the sphere tick by tick, inside the wheels' limits."""

    def __init__(
        self,
        dt: float,
        wheels_from_sphere: Mat3,
        sphere_from_wheels: Mat3,
        limits: WheelLimits,
    ) -> None:
        """Start at rest; dt in s.

        The maps are J^-1 (rad/s of wheels per rad/s of the sphere) and J.
        """
        self._dt = dt
        self._wheels_from_sphere, self._sphere_from_wheels = wheels_from_sphere, sphere_from_wheels
        one, two, three = zip(limits.speed, limits.acceleration, limits.jerk, strict=True)
        self._axes = (
            AxisSmoothing(dt, *one, limits.stop_share),
            AxisSmoothing(dt, *two, limits.stop_share),
            AxisSmoothing(dt, *three, limits.stop_share),
        )
        self._braking, self._braking_jerk = (
            self._reserve(limits.acceleration),
            self._reserve(limits.jerk),
        )
        self._speed, self._acceleration = ZERO, ZERO
        self._left, self._cue_speed = IDENTITY, ZERO
        self.q_WS, self.w_WS_W, self.alpha_WS_W = IDENTITY, ZERO, ZERO
        self._angle = ZERO

    @property
    def wheel_motion(self) -> tuple[Vec3, Vec3, Vec3]:
        """Angle (rad, from zero at the start), speed (rad/s), acceleration (rad/s^2) of wheels."""
        return self._angle, self._speed, self._acceleration

    def start(self, cue: Cue) -> None:
        """Begin at rest in the cue's orientation."""
        self._speed, self._acceleration, self._left = ZERO, ZERO, IDENTITY
        self.w_WS_W, self.alpha_WS_W, self._angle = ZERO, ZERO, ZERO
        self.q_WS, self._cue_speed = (
            normalise(cue.q_WS),
            apply(self._wheels_from_sphere, cue.w_WS_W),
        )

    def step(self, cue: Cue) -> bool:
        """Follow the cue for one tick; return whether the wheels gave it.

        Raises PlanningError and stays where it is.
        """
        (x, y, z), near = self.wanted(cue)
        self.fly(x, y, z)
        return x.met and y.met and z.met and near

    def wanted(self, cue: Cue) -> tuple[tuple[Step, Step, Step], bool]:
        """Give the wheels' steps towards the cue, and whether it is near. Raises PlanningError."""
        to_go = self._to_go(cue)
        angle = norm(to_go)
        u, a = self._demand(cue, to_go, angle)
        axes, speed, acceleration = self._axes, self._speed, self._acceleration
        x = axes[0].towards(speed[0], acceleration[0], u[0], a[0])
        y = axes[1].towards(speed[1], acceleration[1], u[1], a[1])
        z = axes[2].towards(speed[2], acceleration[2], u[2], a[2])
        return (x, y, z), angle <= _MET_ANGLE

    def stop(self) -> None:
        """Follow the certified stop for one tick."""
        x, y, z = self.stopping()
        self.fly(x, y, z)
        self._cue_speed = self._speed

    def stopping(self) -> tuple[Step, Step, Step]:
        """Give the wheels' steps into the certified stop."""
        (one, two, three), v, a = self._axes, self._speed, self._acceleration
        return (
            one.stopping(v[0], a[0]),
            two.stopping(v[1], a[1]),
            three.stopping(v[2], a[2]),
        )

    @property
    def axes(self) -> tuple[AxisSmoothing, AxisSmoothing, AxisSmoothing]:
        """The wheels."""
        return self._axes

    def _to_go(self, cue: Cue) -> Vec3:
        """Give the rotation vector (rad, W) still to go at the end of the tick at the cue's rate.

        The rate is integrated by the trapezoid. It goes by the shorter way, but a catch-up under
        way is not turned round by a cue that wanders past half a turn.
        """
        self._left = continuous(difference(self.q_WS, cue.q_WS), self._left)
        to_go = log_unwound(self._left)
        if norm(to_go) > pi + _OTHER_WAY:
            w, x, y, z = self._left
            self._left = (-w, -x, -y, -z)
            to_go = log_unwound(self._left)
        return subtract(to_go, scale(0.5 * self._dt, add(self.w_WS_W, cue.w_WS_W)))

    def _demand(self, cue: Cue, to_go: Vec3, angle: float) -> tuple[Vec3, Vec3]:
        """Give the wheel speeds and accelerations asked for at the end of the tick.

        The cue's acceleration is its last difference.
        """
        speed = apply(self._wheels_from_sphere, cue.w_WS_W)
        acceleration = scale(1.0 / self._dt, subtract(speed, self._cue_speed))
        self._cue_speed = speed
        if angle <= _NO_ANGLE:
            return speed, acceleration
        direction = scale(1.0 / angle, apply(self._wheels_from_sphere, to_go))
        closing, slope = approach(angle, _GAIN, self._braking, self._braking_jerk)
        if not self._have(add(speed, scale(closing, direction))):
            closing, slope = min(closing, self._spare(speed, direction)), 0.0
        across = cross(cue.w_WS_W, scale(closing / angle, to_go))
        return add(speed, scale(closing, direction)), add(
            subtract(acceleration, scale(slope * closing, direction)),
            apply(self._wheels_from_sphere, across),
        )

    def _have(self, wheels: Vec3) -> bool:
        """Whether the wheels can turn that fast."""
        one, two, three = self._axes
        return (
            abs(wheels[0]) < one.speed
            and abs(wheels[1]) < two.speed
            and abs(wheels[2]) < three.speed
        )

    def _spare(self, wheels: Vec3, direction: Vec3) -> float:
        """Give the largest closing rate (rad/s) that keeps each wheel inside its speed.

        wheels: speeds (rad/s) that the cue takes already; direction: of the closing, per rad/s.
        """
        spare = inf
        for axis, busy, d in zip(self._axes, wheels, direction, strict=True):
            if d > 0.0:
                spare = min(spare, (axis.speed - busy) / d)
            elif d < 0.0:
                spare = min(spare, (axis.speed + busy) / -d)
        return max(spare, 0.0)

    def fly(self, x: Step, y: Step, z: Step) -> None:
        """Take the steps of the three wheels and integrate the orientation (Eq. 16, 19, 20).

        This is the one place where the orientation is renormalised.
        """
        turned = (x.displacement, y.displacement, z.displacement)
        self._angle = add(self._angle, turned)
        turn = apply(self._sphere_from_wheels, turned)
        self._speed, self._acceleration = (x.v, y.v, z.v), (x.a, y.a, z.a)
        w0, self.w_WS_W = self.w_WS_W, apply(self._sphere_from_wheels, self._speed)
        self.alpha_WS_W = apply(self._sphere_from_wheels, self._acceleration)
        self.q_WS = normalise(integrate_base(self.q_WS, turn, w0, self.w_WS_W, self._dt))

    def _reserve(self, limit: Vec3) -> float:
        """Give the angular acceleration or jerk about any axis to plan a catch-up with.

        It is what the wheels' limits leave.
        """
        rows = (norm(row) for row in self._wheels_from_sphere)
        return _BRAKING_SHARE * min(each / row for each, row in zip(limit, rows, strict=True))
