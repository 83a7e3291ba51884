"""Method `blend`: the vehicle's rates at once, the direction of its specific force before long."""

from math import atan2, pi

from ..rotation import ZERO, Quat, Vec3, cross, dot, flip, multiply, norm, rotate, scale, shortest_arc, up_in_body
from ..signals import VehicleState
from .cabin import Cabin, cabin_rate, upright
from .parameters import BlendParameters

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
        self._dt, self._parameters = dt, parameters
        self._cabin: Cabin | None = None

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Orientation q_WS and rate w_WS_W (rad/s) of the cue."""
        w_S = cabin_rate(self._parameters.rotation_gain, vehicle)
        if self._cabin is None:
            self._cabin = Cabin(self._dt, self._aligned(vehicle), w_S, self._parameters.turn)
        else:
            self._cabin.follow(w_S, self._misalignment(self._cabin.q_WS, flip(vehicle.f_B)))
        return self._cabin.cue

    def _aligned(self, vehicle: VehicleState) -> Quat:
        """Vehicle attitude, turned the shortest way so that its specific force points up in W."""
        q_WS = upright(vehicle.q_NB)
        f_W = rotate(q_WS, flip(vehicle.f_B))
        return multiply(shortest_arc(f_W, _UP), q_WS) if norm(f_W) > self._parameters.hold else q_WS

    def _misalignment(self, q_WS: Quat, f_S: Vec3) -> Vec3:
        """Turn of the cabin (rad, S) that would bring W's up to the direction of f_S; faded out near zero force."""
        up_S = up_in_body(q_WS)
        force = norm(f_S)
        weight = _smoothstep(force / self._parameters.hold - 1.0)
        axis, along = cross(f_S, up_S), dot(f_S, up_S)
        size = norm(axis)
        if weight == 0.0 or size <= 1e-9 * force:
            return (weight * pi, 0.0, 0.0) if along < 0.0 else ZERO  # opposite: any axis will do, roll is taken
        return scale(weight * atan2(size, along) / size, axis)


def _smoothstep(x: float) -> float:
    """0 below 0, 1 above 1, and a cubic with level ends between."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)
