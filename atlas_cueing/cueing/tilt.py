"""Gravity as a cue: turning the cabin so that its up lies along a specific force.

A rider at rest feels R_SW (0, 0, g), upwards in W, whose direction in the cabin is u = R_SW z. A fixed direction of W moves in
the cabin with u' = -w x u, so u is turned towards a force f by the rate (f x u) / |f x u|.
"""

from math import atan2, pi

from ..rotation import ZERO, Quat, Vec3, add, cross, dot, flip, multiply, norm, rotate, scale, shortest_arc, up_in_body
from ..signals import VehicleState
from .cabin import upright
from .damping import CriticalDamping

_UP: Vec3 = (0.0, 0.0, 1.0)


def aligned(vehicle: VehicleState, hold: float) -> Quat:
    """q_WS of the vehicle's attitude, turned the shortest way so that its specific force points up in W.

    Not turned where the force is below `hold`, m/s^2.
    """
    q_WS = upright(vehicle.q_NB)
    f_W = rotate(q_WS, flip(vehicle.f_B))
    return multiply(shortest_arc(f_W, _UP), q_WS) if norm(f_W) > hold else q_WS


def misalignment(q_WS: Quat, f_S: Vec3, hold: float) -> Vec3:
    """Turn of the cabin (rotation vector, rad, S) that would bring W's up to the direction of f_S.

    There is no direction near zero force: the turn fades out where |f_S| falls from twice `hold` to `hold`, m/s^2.
    """
    up_S = up_in_body(q_WS)
    force = norm(f_S)
    weight = presence(force, hold)
    axis, along = cross(f_S, up_S), dot(f_S, up_S)
    size = norm(axis)
    if weight == 0.0 or size <= 1e-9 * force:
        return (weight * pi, 0.0, 0.0) if along < 0.0 else ZERO  # opposite: any axis will do, roll is taken
    return scale(weight * atan2(size, along) / size, axis)


def presence(force: float, hold: float) -> float:
    """0 up to a force of `hold`, 1 from twice that on, and a cubic with level ends between."""
    x = min(max(force / hold - 1.0, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


class ForceDirection:
    """The vehicle's specific force in the cabin, filtered, and the cabin rate that stays with it.

    f passes a critically damped filter, which gives f' as well. u = f / |f| stays W's up if -w x u = u', so

        w = (f' x f) / |f|^2 + (w_vehicle . f) f / |f|^2

    with the first term across f, and the vehicle's own turn about it. Near zero force, where f has no direction, it fades over
    to the vehicle's rate (`presence`).
    """

    def __init__(self, dt: float, bandwidth: float, hold: float, f_S: Vec3) -> None:
        """Begin with the lasting force f_S, m/s^2; natural frequency `bandwidth` in rad/s; dt in s."""
        self._damping, self._hold = CriticalDamping(bandwidth, dt), hold
        self.f_S, self._rate = f_S, ZERO

    def step(self, f_S: Vec3) -> None:
        """Take the force one tick on, m/s^2 in S."""
        (x, y, z), (vx, vy, vz), step = self.f_S, self._rate, self._damping.step
        (x, vx), (y, vy), (z, vz) = step(x, vx, f_S[0]), step(y, vy, f_S[1]), step(z, vz, f_S[2])
        self.f_S, self._rate = (x, y, z), (vx, vy, vz)

    def carried(self, w_S: Vec3) -> Vec3:
        """Rate (rad/s, S) that carries W's up along with f, and the cabin about it with the vehicle's rate w_S."""
        force = norm(self.f_S)
        there = presence(force, self._hold)
        share = there / max(force, self._hold) ** 2
        with_force = add(scale(share, cross(self._rate, self.f_S)), scale(share * dot(w_S, self.f_S), self.f_S))
        return add(with_force, scale(1.0 - there, w_S))
