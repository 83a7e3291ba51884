"""Gravity as a cue: turning the cabin so that its up lies along a specific force.

A rider at rest feels R_SW (0, 0, g), upwards in W, whose direction in the cabin is u = R_SW z. A
fixed direction of W moves in the cabin with u' = -w x u, so u is turned towards a force f by the
rate (f x u) / |f x u|.
"""

# mypyc: runs every tick

from math import atan2, pi

from ..rotation import (
    ZERO,
    Quat,
    Vec3,
    add,
    cross,
    dot,
    flip,
    multiply,
    norm,
    rotate,
    scale,
    shortest_arc,
    up_in_body,
)
from ..signals import VehicleState
from .cabin import upright
from .damping import DampedVector

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

    There is no direction near zero force: the turn fades out where |f_S| falls from twice `hold` to
        `hold`, m/s^2.
    """
    up_S = up_in_body(q_WS)
    force = norm(f_S)
    weight = fade_in(force, hold)
    axis, along = cross(f_S, up_S), dot(f_S, up_S)
    size = norm(axis)
    if weight == 0.0 or size <= 1e-9 * force:
        return scale(weight * pi, _across(up_S)) if along < 0.0 else ZERO
    return scale(weight * atan2(size, along) / size, axis)


def _across(up_S: Vec3) -> Vec3:
    """A unit vector across up_S, near the roll axis where that can be: any will do for a force straight down."""
    x, y, z = up_S
    across = (1.0 - x * x, -x * y, -x * z) if abs(x) < 0.7 else (-y * x, 1.0 - y * y, -y * z)
    return scale(1.0 / norm(across), across)


def fade_in(force: float, hold: float) -> float:
    """0 up to a force of `hold`, 1 from twice that on, and a cubic with level ends between."""
    x = min(max(force / hold - 1.0, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


class ForceDirection:
    """The vehicle's specific force in the cabin, filtered, and the cabin rate that stays with it.

    f passes a critically damped filter, which gives f' as well. u = f / |f| stays W's up if -w x u
    = u', so

        w = (f' x f) / |f|^2 + (w_vehicle . f) f / |f|^2

    with the first term across f, and the vehicle's own turn about it. Near zero force, where f has
    no direction, it fades over to the vehicle's rate (`presence`).
    """

    def __init__(self, dt: float, bandwidth: float, hold: float, f_S: Vec3) -> None:
        """Begin with the lasting force f_S, m/s^2; natural frequency `bandwidth` in rad/s.

        Dt in s.
        """
        self._force, self._hold = DampedVector(bandwidth, dt, f_S), hold

    def step(self, f_S: Vec3) -> Vec3:
        """Take the force one tick on; the filtered force, m/s^2 in S."""
        return self._force.step(f_S)

    def carried(self, w_S: Vec3) -> Vec3:
        """Rate (rad/s, S) that carries W's up along with f, and the cabin about it with the vehicle's rate w_S."""
        f_S, rate = self._force.x, self._force.v
        force = norm(f_S)
        there = fade_in(force, self._hold)
        along = scale(1.0 / max(force, self._hold), f_S)
        across = cross(scale(1.0 / max(force, self._hold), rate), along)
        return add(
            scale(there, add(across, scale(dot(w_S, along), along))), scale(1.0 - there, w_S)
        )
