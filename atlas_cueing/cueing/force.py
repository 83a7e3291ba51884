"""Method `force`: the cabin's gravity follows the direction of the vehicle's specific force."""

# mypyc: runs every tick

from dataclasses import dataclass
from math import pi

from ..rotation import Quat, Vec3, flip
from ..signals import VehicleState
from .cabin import Cabin, SlowTurnParameters, cabin_rate, slow_turn
from .method import Method
from .parameter import ONES, Parameter, Range
from .stage.stage_parameters import GAIN
from .tilt import HOLD, ForceDirection, aligned, misalignment

FAST_TURN = SlowTurnParameters(rate=pi, time=0.5, smoothing=0.1)


@dataclass(frozen=True, slots=True)
class ForceParameters:
    """Parameters of `force`; METHOD says what each is.

    turn: takes back what misalignment is left.
    """

    rotation_gain: Vec3 = ONES
    bandwidth: float = 2.0 * pi
    hold: float = 1.5
    turn: SlowTurnParameters = FAST_TURN

    def rotation(self, dt: float) -> "ForceRotation":
        """Make the rotation that begins at the first state; dt in s."""
        return ForceRotation(dt, self)


class ForceRotation:
    """W's up is carried along with the filtered specific force, at any rate.

    About it the cabin turns with the vehicle. What is left of the misalignment, also after zero
    force or a reversal, is taken back by the feedback turn.
    """

    def __init__(self, dt: float, parameters: ForceParameters) -> None:
        """Begin at the first state, aligned with its force; dt in s."""
        self._dt, self._parameters = dt, parameters
        self._parts: tuple[Cabin, ForceDirection] | None = None

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state."""
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


METHOD = Method(
    "force",
    "W's up follows the vehicle's specific force in the cabin",
    ForceParameters(),
    (
        Parameter(
            "rotation_gain",
            "rotation_gain",
            GAIN,
            "factor on the vehicle's rates, of which only what lies along the force is used",
            "one to one",
        ),
        Parameter(
            "bandwidth_rad_s",
            "bandwidth",
            Range(0.01, 50.0),
            "natural frequency of the filter on the force",
            "assumed: 1 Hz, above manoeuvres and below buffeting",
        ),
        *slow_turn("align", 720.0, "assumed: half a turn a second, as fast as the wheels of Atlas"),
        HOLD,
    ),
)
