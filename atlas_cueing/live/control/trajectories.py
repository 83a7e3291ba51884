"""Trajectories of the platform: follow the cue, stay, park, and engage.

Each trajectory starts smoothly from a given motion and makes one Cue a tick. Smoothing, wheels and
guard come after it as after any cue, so that a trajectory need not keep the limits exactly. The
stop of a hold is none of them (`gentle_stop`): smoothing would follow it with a lag, and a lag is
an overshoot. All positions and orientations are in W.
"""

# mypyc: runs every tick

from math import pi, radians, sqrt
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

CALM_RATE = radians(60.0)  # rad/s at most on the way to park, or to the cue (assumed)
CALM_SPEED = 0.5  # m/s at most on the same ways (assumed)
CALM_ACCELERATION = 0.8  # m/s^2 at most on the same ways (assumed)
SHORTEST_PARKING = 1.0  # s
# rad; a turn that has grown beyond it on the way to the cue is made the other way round (assumed)
_OTHER_WAY = 1.5 * pi
PEAK_RATE, PEAK_BEND = 1.875, 10.0 / sqrt(3.0)  # of `smoothstep`, per duration and per duration^2


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


class ParkTrajectory:
    """Moves from rest to upright in the centre, the shorter way round, in one smooth move."""

    def __init__(self, motion: Motion, dt: float, duration: float) -> None:
        """Start where `motion` rests; tick and duration in s."""
        self._dt, self._elapsed, self._duration = dt, 0.0, duration
        self._q, self._p = motion.q_WS, motion.p_WS_W
        self._turn = turn_home(motion.q_WS)

    def step(self, cue: Cue) -> Cue:
        """Return the next cue on the way to park."""
        self._elapsed += self._dt
        s, ds, dds = smoothstep(self._elapsed / self._duration)
        rate, bend = ds / self._duration, dds / self._duration**2
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
        return self._elapsed >= self._duration


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


def turn_home(q_WS: Quat) -> Vec3:
    """Return the shorter turn (rotation vector, rad, W) from an orientation to upright."""
    return log(conjugate(q_WS))


def calm_time(angle: float, distance: float) -> float:
    """Return the duration (s) of a calm move from rest to rest by `angle` (rad), `distance` (m)."""
    by_rate = PEAK_RATE * max(angle / CALM_RATE, distance / CALM_SPEED)
    return max(by_rate, sqrt(PEAK_BEND * distance / CALM_ACCELERATION))


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
