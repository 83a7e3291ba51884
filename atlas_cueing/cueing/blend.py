"""Method `blend`: the vehicle's rates at once, the direction of its specific force before long."""

# mypyc: runs every tick

from dataclasses import dataclass
from math import pi

from ..rotation import Quat, Vec3, flip
from ..signals import VehicleState
from .cabin import SLOW_TURN, Cabin, SlowTurnParameters, cabin_rate, slow_turn
from .method import Method
from .parameter import ONES, Parameter
from .stage.stage_parameters import GAIN
from .tilt import HOLD, LastingRate, aligned, misalignment


@dataclass(frozen=True, slots=True)
class BlendParameters:
    """Parameters of `blend`; METHOD says what each is.

    bandwidth: natural frequency of the filter on the force whose turning the slow turn goes along
        with, rad/s (assumed); fixed.
    """

    rotation_gain: Vec3 = ONES
    bandwidth: float = 2.0 * pi
    hold: float = 1.5
    turn: SlowTurnParameters = SLOW_TURN

    def rotation(self, dt: float) -> "BlendRotation":
        """Make the rotation that begins at the first state; dt in s."""
        return BlendRotation(dt, self)


class BlendRotation:
    """Cabin rate = gain * body rate + slow turn towards the vehicle's specific force.

    Nothing returns to neutral.

    The slow turn takes the cabin from the rate of the vehicle to the rate that stays with the force
    (as in method `force`, both behind the same filter), and takes back what misalignment is left.
    So fast turns are the vehicle's own, lasting ones keep the direction of the force, and where the
    two agree the rates pass one to one. Its limit (3 deg/s) is also the method's: in a level turn
    at rate psi' and bank phi it has to undo psi' sin(phi), and beyond that the cabin cannot stay
    with the force.
    """

    def __init__(self, dt: float, parameters: BlendParameters) -> None:
        """Begin at the first state, aligned with its force; dt in s."""
        self._dt, self._parameters = dt, parameters
        self._parts: tuple[Cabin, LastingRate] | None = None

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state."""
        w_S, f_S = cabin_rate(self._parameters.rotation_gain, vehicle), flip(vehicle.f_B)
        if self._parts is None:
            self._parts = self._begin(vehicle, w_S, f_S)
            return self._parts[0].cue
        cabin, lasting = self._parts
        extra = lasting.step(w_S, f_S)
        cabin.carry(w_S)
        cabin.correct(misalignment(cabin.q_WS, f_S, self._parameters.hold), extra)
        return cabin.cue

    def _begin(self, vehicle: VehicleState, w_S: Vec3, f_S: Vec3) -> tuple[Cabin, LastingRate]:
        dt, parameters = self._dt, self._parameters
        cabin = Cabin(dt, aligned(vehicle, parameters.hold), w_S, parameters.turn)
        return cabin, LastingRate(dt, parameters.bandwidth, parameters.hold, w_S, f_S)


METHOD = Method(
    "blend",
    "body rates one to one, plus a slow turn towards the vehicle's specific force",
    BlendParameters(),
    (
        Parameter(
            "rotation_gain",
            "rotation_gain",
            GAIN,
            "factor on the vehicle's rates about the cabin's x, y, z",
            "one to one",
        ),
        *slow_turn("align", 90.0),
        HOLD,
    ),
    fixed=("bandwidth",),
)
