"""What the stage should do: the onset of the acceleration that the rider's head lacks, inside the travel.

A rider feels f = R_SW (a_head - g_W), so the head should have a_head = R_WS f_vehicle + g_W. For a head off the centre the
sphere's own turning gives alpha x r + w x (w x r) of it; the rest, d, is asked of the stage. A stage of finite travel can
give only the onset of a lasting demand:

    u = d s / (s + omega_r)        p = u / (s + omega)^2        a = p''

brakes with the natural frequency omega and comes back to the centre with omega_r. The demand is limited beforehand, by
A tanh(d / A), so that no demand whatever, by the L1 norms of the filter, can drive p, v or a out of their bounds.
"""

from math import e, exp, pi, tanh

from ..rotation import ZERO, Quat, Vec3, add, cross, flip, rotate, scale, subtract
from ..signals import STANDARD_GRAVITY, StageLimits
from .damping import CriticalDamping
from .parameters import StageParameters

_GRAVITY_W: Vec3 = (0.0, 0.0, -STANDARD_GRAVITY)


class OnsetFilter:
    """One axis of the stage: demand (m/s^2) in, position, velocity and acceleration out."""

    def __init__(self, dt: float, onset: float, recentre: float, bandwidth: float, bound: float) -> None:
        """Parameters as in StageParameters, for one axis; `bound` is A, m/s^2; dt in s."""
        self._omega, self._bound = onset, bound
        self._braking = CriticalDamping(onset, dt)
        self._pass = 1.0 - exp(-2.0 * pi * bandwidth * dt)
        self._drain = 1.0 - exp(-recentre * dt)
        self._demand = self._lasting = self._p = self._v = self._u = 0.0
        self._started = False

    def step(self, demand: float) -> tuple[float, float, float]:
        """Position, velocity and acceleration after one tick; a demand that is there at the start counts as lasting."""
        limited = self._bound * tanh(demand / self._bound)
        if not self._started:
            self._demand = limited
            self._lasting = limited
            self._started = True
        self._demand += self._pass * (limited - self._demand)
        self._lasting += self._drain * (self._demand - self._lasting)
        before, self._u = self._u, self._demand - self._lasting
        omega = self._omega
        self._p, self._v = self._braking.step(self._p, self._v, 0.5 * (before + self._u) / (omega * omega))
        return self._p, self._v, self._u - omega * (2.0 * self._v + omega * self._p)


class StageCueing:
    """Stage position, velocity and acceleration (W) from the cue's orientation and the vehicle's specific force."""

    def __init__(self, dt: float, parameters: StageParameters, limits: StageLimits, head_S: Vec3) -> None:
        """head_S: the rider's head from the sphere centre, m, frame S; dt in s."""
        self._dt, self._gain, self._head = dt, parameters.force_gain, head_S
        travel = [min(pair) for pair in zip(limits.travel, parameters.travel, strict=True)]
        bounds = map(demand_bound, parameters.onset, travel, limits.speed, limits.acceleration)
        each = zip(parameters.onset, parameters.recentre, bounds, strict=True)
        self._axes = [OnsetFilter(dt, onset, recentre, parameters.bandwidth, bound) for onset, recentre, bound in each]
        self._w_before: Vec3 | None = None

    def step(self, q_WS: Quat, w_WS_W: Vec3, f_B: Vec3) -> tuple[Vec3, Vec3, Vec3]:
        """Position (m), velocity (m/s) and acceleration (m/s^2) in W."""
        wanted = add(rotate(q_WS, flip(f_B)), _GRAVITY_W)
        lacking = subtract(wanted, self._turning(q_WS, w_WS_W))
        (one, two, three), gain = self._axes, self._gain
        x, y, z = one.step(gain[0] * lacking[0]), two.step(gain[1] * lacking[1]), three.step(gain[2] * lacking[2])
        return (x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2])

    def _turning(self, q_WS: Quat, w_WS_W: Vec3) -> Vec3:
        """Acceleration of the head (W) that the sphere's turning makes."""
        before, self._w_before = self._w_before or w_WS_W, w_WS_W
        if self._head == ZERO:
            return ZERO
        r = rotate(q_WS, self._head)
        alpha = scale(1.0 / self._dt, subtract(w_WS_W, before))
        return add(cross(alpha, r), cross(w_WS_W, cross(w_WS_W, r)))


def demand_bound(onset: float, travel: float, speed: float, acceleration: float) -> float:
    """Largest demand A (m/s^2) that keeps the filter inside travel, speed and acceleration, whatever it was and is.

    |u| <= 2 A, since the lasting part of a demand within A is within A. The L1 norms of 1, s and s^2 over (s + omega)^2 are
    1 / omega^2, 2 / (e omega) and 2 + 2 / e^2.
    """
    worst = (1.0 / onset**2, 2.0 / (e * onset), 2.0 + 2.0 / e**2)
    return 0.5 * min(travel / worst[0], speed / worst[1], acceleration / worst[2])
