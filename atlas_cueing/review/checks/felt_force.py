"""Check of the felt force: is it what the logged motion makes a rider feel?"""

import numpy as np

from ...rotations import Array
from ..finding import Finding, exceeding
from ..own_rotations import cross, turned, turned_back
from ..recorded_run import RecordedRun

# m/s^2 and rad/s; the same formula in another order was within 1e-13 on every bundled flight
FORCE = 1e-9
DIRECTION = 1e-7  # rad; angles near 0 and pi lose half the digits
_GRAVITY_W = np.array([0.0, 0.0, -9.80665])
_FRD = np.array([1.0, -1.0, -1.0])


def check_felt_force(run: RecordedRun) -> list[Finding]:
    """Check specific force and rate at the rider's head, and the angle to the pilot's force.

    In cabin FRD the force is f = R_SW (a + alpha x r + w x (w x r) - g), with r from the sphere's
    centre to the head.
    """
    flight = run.flight
    force, rate = felt_again(run)
    angle = _angle(flight.vehicle_f_B, force)
    logged = run.log.column("/felt", "direction_error_rad")[: len(angle)]
    check, difference = "not what the motion makes the rider feel", "difference"
    names_f, names_w = (
        [f"/felt {v}{c}_{unit}" for c in "xyz"] for v, unit in (("f", "m_s2"), ("w", "rad_s"))
    )
    place = ["/felt direction_error_rad"]
    return [
        *exceeding(
            check, names_f, flight.time, flight.felt_f - force, FORCE, "m/s2", quantity=difference
        ),
        *exceeding(
            check, names_w, flight.time, flight.felt_w - rate, FORCE, "rad/s", quantity=difference
        ),
        *exceeding(
            check, place, flight.time, logged - angle, DIRECTION, "rad", quantity=difference
        ),
    ]


def felt_again(run: RecordedRun) -> tuple[Array, Array]:
    """Specific force (m/s^2) and rate (rad/s) at the head from the motion, cabin FRD, (n, 3)."""
    flight = run.flight
    q, w = flight.motion_q_WS, flight.motion_w_W
    r = turned(q, np.array(run.platform.head_S))
    force = flight.motion_a_W + cross(flight.motion_alpha_W, r) + cross(w, cross(w, r)) - _GRAVITY_W
    return turned_back(q, force) * _FRD, turned_back(q, w) * _FRD


def _angle(a: Array, b: Array) -> Array:
    """Angles (n,), rad, between the rows of a and b (n, 3), by the half-angle formula.

    It is exact near 0 and near pi, where the cosine is not, and 0 where a row is zero.
    """
    length_a, length_b = (np.linalg.norm(v, axis=1, keepdims=True) for v in (a, b))
    u, v = a * length_b, b * length_a
    angle: Array = 2.0 * np.arctan2(np.linalg.norm(u - v, axis=1), np.linalg.norm(u + v, axis=1))
    return angle
