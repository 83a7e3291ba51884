"""Trajectories of the platform: follow the cue, hold, stop, park, and engage.

Each trajectory starts smoothly from a given motion and makes one Cue a tick. Smoothing, wheels and
guard come after it as after any cue, so that a trajectory need not keep the limits exactly. All
positions and orientations are in W.
"""

# mypyc: runs every tick

from math import inf, pi, radians, sqrt
from typing import Protocol

from ...rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    add,
    conjugate,
    continuous,
    difference,
    exp,
    log,
    log_unwound,
    multiply,
    norm,
    normalise,
    scale,
    subtract,
)
from ...signals import Cue, Motion

STOP_TIME = 0.8  # s; from full speed to rest (assumed; the wheels' limits would allow half of it)
CALM_RATE = radians(60.0)  # rad/s at most on the way to park, or to the cue (assumed)
CALM_SPEED = 0.5  # m/s at most on the same ways (assumed)
CALM_ACCELERATION = 0.8  # m/s^2 at most on the same ways (assumed)
SHORTEST_PARKING = 1.0  # s
# rad; a turn that has grown beyond it on the way to the cue is made the other way round (assumed)
_OTHER_WAY = 1.5 * pi
_PEAK_RATE, _PEAK_BEND = 1.875, 10.0 / sqrt(3.0)  # of `smoothstep`, per duration and per duration^2


class Trajectory(Protocol):
    """A motion of the platform, one step a tick."""

    def step(self, cue: Cue) -> Cue:
        """Return where to be one tick on; `cue` is what the cueing demands at the same time."""

    @property
    def arrived(self) -> bool:
        """Whether the trajectory has reached its end."""


class FollowTrajectory:
    """Follows the cue."""

    arrived = True

    def step(self, cue: Cue) -> Cue:
        """Return the cue itself."""
        return cue


class HoldTrajectory:
    """Stays at rest at the position and orientation of a motion."""

    arrived = True

    def __init__(self, motion: Motion) -> None:
        self._q, self._p = motion.q_WS, motion.p_WS_W

    def step(self, cue: Cue) -> Cue:
        """Return the same position and orientation again."""
        return Cue(cue.time, self._q, ZERO, self._p, ZERO, ZERO)


class StopTrajectory:
    """Comes to rest: rates fade out by 1 - smoothstep, faster where the travel is about to end."""

    def __init__(self, motion: Motion, dt: float, travel: Vec3) -> None:
        """Start from `motion`; tick dt in s, travel of the stage to either side in m."""
        self._dt, self._elapsed = dt, 0.0
        self._q, self._w = motion.q_WS, motion.w_WS_W
        self._p, self._v = motion.p_WS_W, motion.v_WS_W
        each = zip(motion.p_WS_W, motion.v_WS_W, travel, strict=True)
        self._time = STOP_TIME
        self._rails = tuple(min(STOP_TIME, _time_left(p, v, limit)) for p, v, limit in each)

    def step(self, cue: Cue) -> Cue:
        """Return the next cue on the way to rest."""
        self._elapsed += self._dt
        turned, rate, _ = _fading(self._elapsed, self._time)
        x, y, z = (_fading(self._elapsed, time) for time in self._rails)
        (px, py, pz), (vx, vy, vz) = self._p, self._v
        return Cue(
            cue.time,
            normalise(multiply(exp(scale(turned, self._w)), self._q)),
            scale(rate, self._w),
            (px + x[0] * vx, py + y[0] * vy, pz + z[0] * vz),
            (x[1] * vx, y[1] * vy, z[1] * vz),
            (x[2] * vx, y[2] * vy, z[2] * vz),
        )

    @property
    def arrived(self) -> bool:
        """Whether it is at rest."""
        return self._elapsed >= self._time


class ParkTrajectory:
    """Moves from rest to upright in the centre, the shorter way round, in one smooth move."""

    def __init__(self, motion: Motion, dt: float) -> None:
        """Start where `motion` rests; tick dt in s."""
        self._dt, self._elapsed = dt, 0.0
        self._q, self._p = motion.q_WS, motion.p_WS_W
        self._turn = log(conjugate(motion.q_WS))
        self.duration = max(SHORTEST_PARKING, calm_time(norm(self._turn), norm(self._p)))

    def step(self, cue: Cue) -> Cue:
        """Return the next cue on the way to park."""
        self._elapsed += self._dt
        s, ds, dds = smoothstep(self._elapsed / self.duration)
        rate, bend = ds / self.duration, dds / self.duration**2
        q = normalise(multiply(exp(scale(s, self._turn)), self._q))
        back = scale(-1.0, self._p)
        return Cue(
            cue.time,
            q,
            scale(rate, self._turn),
            add(self._p, scale(s, back)),
            scale(rate, back),
            scale(bend, back),
        )

    @property
    def arrived(self) -> bool:
        """Whether it is upright in the centre."""
        return self._elapsed >= self.duration


class EngageTrajectory:
    """Blends from rest to a moving cue.

    The stage's position is x = s x_cue + (1 - s) x_0 with s = smoothstep(t / T). On the sphere the
    same is done tick by tick: the orientation takes the share s of the cue's own turn, and then, of
    what is left to the cue, the share (s1 - s0) / (1 - s0) that brings s to its next value; its
    rate is s w_cue + s' / (1 - s) e, with e = log(q_cue q*) the turn still left: the shorter way to
    begin with, and not changed over for a cue that runs away past half a turn.
    """

    def __init__(self, motion: Motion, cue: Cue, dt: float, duration: float) -> None:
        """Start where `motion` rests, with the cue of the same time; dt and `duration` in s."""
        self._dt, self._elapsed, self._duration = dt, 0.0, duration
        self._q, self._q_cue, self._p = motion.q_WS, cue.q_WS, motion.p_WS_W
        self._left = continuous(difference(self._q, self._q_cue), IDENTITY)

    def step(self, cue: Cue) -> Cue:
        """Return the next cue on the way to the moving one."""
        s0 = smoothstep(self._elapsed / self._duration)[0]
        self._elapsed += self._dt
        s, ds, dds = smoothstep(self._elapsed / self._duration)
        if self.arrived:
            return cue
        rate, bend = ds / self._duration, dds / self._duration**2
        w = self._turn(cue, s0, s, rate)
        gap = subtract(cue.p_WS_W, self._p)
        v = add(scale(s, cue.v_WS_W), scale(rate, gap))
        a = add(add(scale(s, cue.a_WS_W), scale(2.0 * rate, cue.v_WS_W)), scale(bend, gap))
        return Cue(cue.time, self._q, w, add(self._p, scale(s, gap)), v, a)

    @property
    def arrived(self) -> bool:
        """Whether it has reached the cue."""
        return self._elapsed >= self._duration - 0.5 * self._dt

    def _turn(self, cue: Cue, s0: float, s: float, rate: float) -> Vec3:
        """Turn the orientation one tick on; return its rate (rad/s)."""
        moved = exp(scale(s0, log(difference(self._q_cue, cue.q_WS))))
        self._q_cue = cue.q_WS
        q = multiply(moved, self._q)
        left = self._to_go(q, cue)
        share = (s - s0) / (1.0 - s0)
        self._q = normalise(multiply(exp(scale(share, left)), q))
        return add(scale(s, cue.w_WS_W), scale((1.0 - share) * rate / (1.0 - s), left))

    def _to_go(self, q: Quat, cue: Cue) -> Vec3:
        """Return the rotation vector (rad) from q to the cue, kept on one way round."""
        self._left = continuous(difference(q, cue.q_WS), self._left)
        left = log_unwound(self._left)
        if norm(left) <= _OTHER_WAY:
            return left
        self._left = continuous(self._left, IDENTITY)
        return log_unwound(self._left)


def calm_time(angle: float, distance: float) -> float:
    """Return the duration (s) of a calm move from rest to rest by `angle` (rad), `distance` (m)."""
    by_rate = _PEAK_RATE * max(angle / CALM_RATE, distance / CALM_SPEED)
    return max(by_rate, sqrt(_PEAK_BEND * distance / CALM_ACCELERATION))


def smoothstep(t: float) -> Vec3:
    """Return s(t) = 10 t^3 - 15 t^4 + 6 t^5 and its first and second derivative.

    s goes from 0 at t <= 0 to 1 at t >= 1. It is the lowest polynomial with s' = s'' = 0 at both
    ends: the path of least jerk from rest to rest (Flash & Hogan, J. Neuroscience 5, 1985).
    """
    if t <= 0.0:
        return ZERO
    if t >= 1.0:
        return (1.0, 0.0, 0.0)
    return (
        t * t * t * (10.0 - t * (15.0 - 6.0 * t)),
        30.0 * t * t * (1.0 - t) * (1.0 - t),
        60.0 * t * (1.0 - t) * (1.0 - 2.0 * t),
    )


def _fading(t: float, duration: float) -> Vec3:
    """Return integral, value and derivative of 1 - smoothstep(t / duration).

    The integral goes from 0 to duration / 2.
    """
    u = min(t / duration, 1.0)
    s, ds, _ = smoothstep(u)
    return duration * u * (1.0 - u * u * u * (2.5 - u * (3.0 - u))), 1.0 - s, -ds / duration


def _time_left(p: float, v: float, travel: float) -> float:
    """Return the duration (s) of a stop that uses up what is left of the travel.

    A stop from speed v needs v times half its duration.
    """
    room = travel - p if v > 0.0 else travel + p
    return max(2.0 * room / abs(v), 1e-3) if v else inf
