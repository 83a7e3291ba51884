"""Method `perceptual`: the force's direction, as soon as the canals let it pass unnoticed."""

# mypyc: runs every tick

from dataclasses import dataclass

from ..rotation import Quat, Vec3, flip
from ..signals import VehicleState
from .cabin import FreeCabin, cabin_rate
from .felt_turn import FELT_TURN, FELT_TURN_KEYS, FeltTurn, FeltTurnParameters
from .method import Method
from .parameter import ONES, Parameter, Range
from .stage.stage_parameters import GAIN
from .tilt import HOLD, LastingRate, aligned, misalignment


@dataclass(frozen=True, slots=True)
class PerceptualParameters:
    """Parameters of `perceptual`; METHOD says what each is.

    turn: the turn that the vehicle does not make.
    """

    rotation_gain: Vec3 = ONES
    bandwidth: float = 8.0
    hold: float = 1.5
    turn: FeltTurnParameters = FELT_TURN

    def rotation(self, dt: float) -> "PerceptualRotation":
        """Make the rotation that begins at the first state; dt in s."""
        return PerceptualRotation(dt, self)


class PerceptualRotation:
    """Cabin rate = gain * body rate + an extra rate that is limited by what of it is felt.

    As in `blend`, the extra rate takes the cabin from the vehicle's rate to the one that stays with
    the force, and takes back what misalignment is left; nothing returns to neutral. But its bound
    is on the felt part alone, so a lasting turn of any rate ends with the force straight down the
    seat, and fast turns pass at first and fade.
    """

    def __init__(self, dt: float, parameters: PerceptualParameters) -> None:
        """Begin at the first state, aligned with its force; dt in s."""
        self._dt, self._parameters = dt, parameters
        self._extra = FeltTurn(dt, parameters.turn)
        self._parts: tuple[FreeCabin, LastingRate] | None = None

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state."""
        w_S, f_S = cabin_rate(self._parameters.rotation_gain, vehicle), flip(vehicle.f_B)
        if self._parts is None:
            self._parts = self._begin(vehicle, w_S, f_S)
            return self._parts[0].cue
        cabin, lasting = self._parts
        extra = lasting.step(w_S, f_S)
        cabin.carry(w_S)
        error = misalignment(cabin.q_WS, f_S, self._parameters.hold)
        cabin.turn(self._extra.step(error, extra, w_S))
        return cabin.cue

    def _begin(self, vehicle: VehicleState, w_S: Vec3, f_S: Vec3) -> tuple[FreeCabin, LastingRate]:
        dt, parameters = self._dt, self._parameters
        cabin = FreeCabin(dt, aligned(vehicle, parameters.hold), w_S)
        return cabin, LastingRate(dt, parameters.bandwidth, parameters.hold, w_S, f_S)


METHOD = Method(
    "perceptual",
    "body rates at first, then the direction of the specific force, limited by what is felt",
    PerceptualParameters(),
    (
        Parameter(
            "rotation_gain",
            "rotation_gain",
            GAIN,
            "factor on the vehicle's rates about the cabin's x, y, z",
            "one to one",
        ),
        Parameter(
            "bandwidth_rad_s",
            "bandwidth",
            Range(0.01, 50.0),
            "natural frequency of the filters on force and rate whose turning is gone along with",
            "found",
        ),
        *FELT_TURN_KEYS,
        HOLD,
    ),
)
