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
    subtract,
    up_in_body,
)
from ..signals import VehicleState
from .cabin import upright
from .damping import DampedVector
from .parameter import Parameter, Range

_UP: Vec3 = (0.0, 0.0, 1.0)


def hold_of(field: str) -> Parameter:
    """Declare the hold of a method's parameters, m/s^2, in the field `field` of them."""
    return Parameter(
        "hold_force_m_s2",
        field,
        Range(0.01, 100.0),
        "the cabin follows the specific force fully from twice this magnitude on, and not below it",
        "assumed",
    )


HOLD = hold_of("hold")


def aligned(vehicle: VehicleState, hold: float) -> Quat:
    """Give q_WS of the vehicle's attitude, turned so that its specific force points up in W.

    The turn is the shortest, and none where the force is below `hold`, m/s^2.
    """
    q_WS = upright(vehicle.q_NB)
    f_W = rotate(q_WS, flip(vehicle.f_B))
    return multiply(shortest_arc(f_W, _UP), q_WS) if norm(f_W) > hold else q_WS


def misalignment(q_WS: Quat, f_S: Vec3, hold: float) -> Vec3:
    """Give the turn of the cabin (rotation vector, rad, S) that brings W's up to the force f_S.

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
    """Give a unit vector across up_S, near the roll axis where that can be.

    For a force straight down any will do.
    """
    x, y, z = up_S
    across = (1.0 - x * x, -x * y, -x * z) if abs(x) < 0.7 else (-y * x, 1.0 - y * y, -y * z)
    return scale(1.0 / norm(across), across)


def fade_in(force: float, hold: float) -> float:
    """Give a weight: 0 up to a force of `hold`, 1 from twice that on, a smooth cubic between."""
    x = min(max(force / hold - 1.0, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


class ForceDirection:
    """The vehicle's specific force in the cabin, filtered, and the cabin rate that stays with it.

    f passes a critically damped filter, which gives f' as well. u = f / |f| stays W's up if -w x u
    = u', so

        w = (f' x f) / |f|^2 + (w_vehicle . f) f / |f|^2

    with the first term across f, and the vehicle's own turn about it. Near zero force, where f has
    no direction, it fades over to the vehicle's rate (`fade_in`).
    """

    def __init__(self, dt: float, bandwidth: float, hold: float, f_S: Vec3) -> None:
        """Begin with the lasting force f_S (m/s^2).

        bandwidth: natural frequency of the filter, rad/s; hold: as in `fade_in`; dt in s.
        """
        self._force, self._hold = DampedVector(bandwidth, dt, f_S), hold

    def step(self, f_S: Vec3) -> Vec3:
        """Take in the force of the next tick; gives the filtered force (m/s^2, S)."""
        return self._force.step(f_S)

    def carried(self, w_S: Vec3) -> Vec3:
        """Give the rate (rad/s, S) that carries W's up along with f.

        About it the cabin turns with the vehicle's rate w_S (rad/s, S).
        """
        f_S, rate = self._force.x, self._force.v
        force = norm(f_S)
        there = fade_in(force, self._hold)
        along = scale(1.0 / max(force, self._hold), f_S)
        across = cross(scale(1.0 / max(force, self._hold), rate), along)
        return add(
            scale(there, add(across, scale(dot(w_S, along), along))), scale(1.0 - there, w_S)
        )


class LastingRate:
    """The cabin rate beyond the vehicle's own that stays with its specific force.

    Force and rate pass the same filter, so that the difference has no lag of its own. In a level
    turn it takes back psi' sin(phi) of the vehicle's rate psi'.
    """

    def __init__(self, dt: float, bandwidth: float, hold: float, w_S: Vec3, f_S: Vec3) -> None:
        """Begin with the lasting rate w_S (rad/s, S) and force f_S (m/s^2, S).

        bandwidth: natural frequency of the filter, rad/s; hold: as in `fade_in`; dt in s.
        """
        self._direction = ForceDirection(dt, bandwidth, hold, f_S)
        self._rate = DampedVector(bandwidth, dt, w_S)

    def step(self, w_S: Vec3, f_S: Vec3) -> Vec3:
        """Take in rate and force of the next tick; give the extra rate (rad/s, S)."""
        self._direction.step(f_S)
        filtered = self._rate.step(w_S)
        return subtract(self._direction.carried(filtered), filtered)
