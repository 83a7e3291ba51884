"""Method `force`: the cabin's gravity follows the direction of the vehicle's specific force."""

# mypyc: runs every tick

from ..rotation import Quat, Vec3, flip
from ..signals import VehicleState
from .cabin import Cabin, cabin_rate
from .parameters import ForceParameters
from .tilt import ForceDirection, aligned, misalignment


class ForceRotation:
    """W's up is carried along the filtered specific force at any rate, and the cabin turns with the vehicle about it.

    Whatever is left of the misalignment, also after zero force or a reversal, is taken back by the
    feedback turn.
    """

    def __init__(self, dt: float, parameters: ForceParameters) -> None:
        """Begin at the first state, aligned with its force; dt in s."""
        self._dt, self._parameters = dt, parameters
        self._parts: tuple[Cabin, ForceDirection] | None = None

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Orientation q_WS and rate w_WS_W (rad/s) of the cue."""
        w_S, f_S = cabin_rate(self._parameters.rotation_gain, vehicle), flip(vehicle.f_B)
        if self._parts is None:
            self._parts = self._begin(vehicle, w_S, f_S)
            return self._parts[0].cue
        cabin, direction = self._parts
        filtered = direction.step(f_S)
        cabin.carry(direction.carried(w_S))
        cabin.correct(misalignment(cabin.q_WS, filtered, self._parameters.hold))
        return cabin.cue

    def _begin(self, vehicle: VehicleState, w_S: Vec3, f_S: Vec3) -> tuple[Cabin, ForceDirection]:
        direction = ForceDirection(self._dt, self._parameters.bandwidth, self._parameters.hold, f_S)
        q_WS = aligned(vehicle, self._parameters.hold)
        return Cabin(self._dt, q_WS, direction.carried(w_S), self._parameters.turn), direction
