"""Method `blend`: the vehicle's rates at once, the direction of its specific force before long."""

from ..rotation import Quat, Vec3, flip, subtract
from ..signals import VehicleState
from .cabin import Cabin, cabin_rate
from .parameters import BlendParameters
from .tilt import ForceDirection, aligned, misalignment


class BlendRotation:
    """Cabin rate = gain * body rate + slow turn towards the vehicle's specific force; nothing returns to neutral.

    The slow turn takes the cabin from the rate of the vehicle to the rate that stays with the force (as in method `force`), and
    takes back what misalignment is left. So fast turns are the vehicle's own, lasting ones keep the direction of the force.
    Its limit (3 deg/s) is also the method's: in a level turn at rate psi' and bank phi it has to undo psi' sin(phi), and
    beyond that the cabin cannot stay with the force.
    """

    def __init__(self, dt: float, parameters: BlendParameters) -> None:
        """Begin at the first state, aligned with its force; dt in s."""
        self._dt, self._parameters = dt, parameters
        self._parts: tuple[Cabin, ForceDirection] | None = None

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Orientation q_WS and rate w_WS_W (rad/s) of the cue."""
        parameters, f_S = self._parameters, flip(vehicle.f_B)
        w_S = cabin_rate(parameters.rotation_gain, vehicle)
        if self._parts is None:
            cabin = Cabin(self._dt, aligned(vehicle, parameters.hold), w_S, parameters.turn)
            self._parts = cabin, ForceDirection(self._dt, parameters.bandwidth, parameters.hold, f_S)
            return cabin.cue
        cabin, direction = self._parts
        direction.step(f_S)
        cabin.carry(w_S)
        cabin.correct(misalignment(cabin.q_WS, f_S, parameters.hold), subtract(direction.carried(w_S), w_S))
        return cabin.cue
