"""Turning the cabin: with the vehicle, and slowly by itself."""

from ..rotation import ZERO, Quat, Vec3, add, conjugate, exp, flip, from_euler, geodesic, multiply, norm, scale, to_euler
from ..signals import VehicleState
from .damping import critically_damped
from .parameters import SlowTurnParameters


class SlowTurn:
    """Rate at which the cabin takes back an error without being noticed.

    The wish error / time, at most `rate` long, passes a critically damped filter in cabin axes. The filter keeps the rate
    inside the ball of its wishes and its derivative below 2 rate / (e smoothing); both bounds hold for any error.
    """

    def __init__(self, dt: float, parameters: SlowTurnParameters) -> None:
        """Start at rest; dt in s."""
        self._dt, self._rate, self._time = dt, parameters.rate, parameters.time
        self._omega = 1.0 / parameters.smoothing
        self._w, self._alpha = ZERO, ZERO

    def step(self, error: Vec3) -> tuple[Vec3, Vec3]:
        """Turn made in this tick (rad) and rate at its end (rad/s), for the rotation vector `error` (rad) still to go."""
        size = norm(error)
        wish = scale(min(1.0 / self._time, self._rate / size) if size > 0.0 else 0.0, error)
        before = self._w
        each = zip(self._w, self._alpha, wish, strict=True)
        (x, ax), (y, ay), (z, az) = (critically_damped(w, a, to, self._omega, self._dt) for w, a, to in each)
        self._w, self._alpha = (x, y, z), (ax, ay, az)
        return scale(0.5 * self._dt, add(before, self._w)), self._w


def level_heading(q_NB: Quat) -> Quat:
    """Rotation from N to the north-east-down frame whose x is the vehicle's heading: what makes W's x the first heading."""
    return from_euler(-to_euler(q_NB)[0], 0.0, 0.0)


def body_turn(before: VehicleState, now: VehicleState) -> Vec3:
    """Rotation vector (rad, FRD) by which the body rates say the vehicle turned between two states (trapezoid)."""
    return scale(0.5 * (now.time - before.time), add(before.w_NB_B, now.w_NB_B))


def attitude_jump(before: VehicleState, now: VehicleState) -> float:
    """Angle (rad) by which the attitude changed beyond what the body rates explain: a reset, reposition or trim in mid-run."""
    turned = multiply(conjugate(before.q_NB), now.q_NB)
    return geodesic(turned, exp(body_turn(before, now)))


def scaled(gain: Vec3, v_B: Vec3) -> Vec3:
    """A body vector (FRD) as a cabin vector (FLU), with a gain for each cabin axis."""
    x, y, z = flip(v_B)
    return (gain[0] * x, gain[1] * y, gain[2] * z)
