"""Method `blend`: the vehicle's rates at once, the direction of its specific force before long."""

from math import pi

from ..rotation import (
    ZERO,
    Quat,
    Vec3,
    add,
    angle_between,
    conjugate,
    cross,
    dot,
    flip,
    flip_rotation,
    integrate_body,
    multiply,
    norm,
    normalise,
    rotate,
    scale,
    shortest_arc,
)
from ..signals import VehicleState
from .parameters import BlendParameters
from .turn import SlowTurn, level_heading, scaled

_UP: Vec3 = (0.0, 0.0, 1.0)


class BlendRotation:
    """Cabin rate = gain * body rate + slow turn towards the vehicle's specific force; nothing returns to neutral.

    A rider at rest feels the specific force R_SW (0, 0, g), upwards in W. Its direction u = R_SW z is turned towards the
    vehicle's force f by the rate (f x u) / |f x u|, because a fixed direction of W moves in the cabin with u' = -w x u.
    The turn about f itself stays with the body rates. Near zero force there is no direction to turn to, and the slow turn
    fades out.
    """

    def __init__(self, dt: float, parameters: BlendParameters) -> None:
        """Begin at the first state, aligned with its force; dt in s."""
        self._dt, self._gain, self._hold = dt, parameters.rotation_gain, parameters.hold
        self._turn = SlowTurn(dt, parameters.turn)
        self._q_WS: Quat | None = None
        self._w_S = ZERO

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Orientation q_WS and rate w_WS_W (rad/s) of the cue."""
        w_S = scaled(self._gain, vehicle.w_NB_B)
        if self._q_WS is None:
            self._q_WS, self._w_S = self._aligned(vehicle), w_S
        else:
            self._q_WS = self._turned(self._q_WS, w_S, flip(vehicle.f_B))
        return self._q_WS, rotate(self._q_WS, self._w_S)

    def _turned(self, q_WS: Quat, w_S: Vec3, f_S: Vec3) -> Quat:
        """Orientation after a tick of the vehicle's rate and the slow turn."""
        _, w_slow = self._turn.step(self._misalignment(q_WS, f_S))
        before, self._w_S = self._w_S, add(w_S, w_slow)
        turn = scale(0.5 * self._dt, add(before, self._w_S))
        return normalise(integrate_body(q_WS, turn, before, self._w_S, self._dt))

    def _aligned(self, vehicle: VehicleState) -> Quat:
        """Vehicle attitude, turned the shortest way so that its specific force points up in W."""
        q_WS = flip_rotation(multiply(level_heading(vehicle.q_NB), vehicle.q_NB))
        f_W = rotate(q_WS, flip(vehicle.f_B))
        return multiply(shortest_arc(f_W, _UP), q_WS) if norm(f_W) > self._hold else q_WS

    def _misalignment(self, q_WS: Quat, f_S: Vec3) -> Vec3:
        """Turn of the cabin (rad, S) that would bring W's up to the direction of f_S; faded out near zero force."""
        up_S = rotate(conjugate(q_WS), _UP)
        weight = _smoothstep(norm(f_S) / self._hold - 1.0)
        axis = cross(f_S, up_S)
        size = norm(axis)
        if weight == 0.0 or size <= 1e-9 * norm(f_S):
            return (weight * pi, 0.0, 0.0) if dot(f_S, up_S) < 0.0 else ZERO
        return scale(weight * angle_between(up_S, f_S) / size, axis)


def _smoothstep(x: float) -> float:
    """0 below 0, 1 above 1, and a cubic with level ends between."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)
