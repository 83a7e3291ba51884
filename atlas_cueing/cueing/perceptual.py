"""Method `perceptual`: the force's direction, as soon as the canals let it pass unnoticed."""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass

from ..rotation import Quat, Vec3, flip
from ..signals import VehicleState
from .cabin import FreeCabin, cabin_rate
from .felt_turn import FELT_TURN, FELT_TURN_KEYS, FeltTurn, FeltTurnParameters
from .look_ahead import LOOK_AHEAD, LookAhead
from .method import Method
from .parameter import ONES, Parameter, Range
from .stage.stage_parameters import GAIN
from .tilt import HOLD, LastingRate, aligned, misalignment


@dataclass(frozen=True, slots=True)
class PerceptualParameters:
    """Parameters of `perceptual`; METHOD says what each is.

    turn: the turn that the vehicle does not make.
    look_ahead: how much later the force and rate are that the lasting rate is made of, s.
    """

    rotation_gain: Vec3 = ONES
    bandwidth: float = 8.0
    hold: float = 1.5
    turn: FeltTurnParameters = FELT_TURN
    look_ahead: float = 0.0

    def rotation(self, dt: float, flight: Sequence[VehicleState] = ()) -> "PerceptualRotation":
        """Make the rotation that begins at the first state.

        Args:
            dt: tick, s.
            flight: every state of the flight, dt apart; it may be empty without look-ahead.

        Raises InputError for look-ahead without a flight.

        """
        return PerceptualRotation(dt, self, flight)


class PerceptualRotation:
    """Cabin rate = gain * body rate + an extra rate that is limited by what of it is felt.

    As in `blend`, the extra rate takes the cabin from the vehicle's rate to the one that stays with
    the force, and takes back what misalignment is left; nothing returns to neutral. But its bound
    is on the felt part alone, so a lasting turn of any rate ends with the force straight down the
    seat, and fast turns pass at first and fade.

    With look-ahead the rate that stays with the force is that of a later state: the filter and the
    canals are met before the turn. Vehicle's rate and misalignment are those of now.
    """

    def __init__(
        self, dt: float, parameters: PerceptualParameters, flight: Sequence[VehicleState] = ()
    ) -> None:
        """Begin at the first state, aligned with its force; as `PerceptualParameters.rotation`."""
        self._dt, self._parameters = dt, parameters
        self._ahead = LookAhead(dt, parameters.look_ahead, flight)
        self._extra = FeltTurn(dt, parameters.turn)
        self._parts: tuple[FreeCabin, LastingRate] | None = None

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state."""
        w_S, f_S = self._sensed(vehicle)
        if self._parts is None:
            self._parts = self._begin(vehicle, w_S, f_S)
            return self._parts[0].cue
        cabin, lasting = self._parts
        later = self._ahead.step(vehicle)
        extra = lasting.step(w_S, f_S) if later is vehicle else lasting.step(*self._sensed(later))
        cabin.carry(w_S)
        error = misalignment(cabin.q_WS, f_S, self._parameters.hold)
        cabin.turn(self._extra.step(error, extra, w_S))
        return cabin.cue

    def _begin(self, vehicle: VehicleState, w_S: Vec3, f_S: Vec3) -> tuple[FreeCabin, LastingRate]:
        dt, parameters = self._dt, self._parameters
        cabin = FreeCabin(dt, aligned(vehicle, parameters.hold), w_S)
        lasting = LastingRate(dt, parameters.bandwidth, parameters.hold, w_S, f_S)
        for later in self._ahead.passed():
            lasting.step(*self._sensed(later))
        return cabin, lasting

    def _sensed(self, vehicle: VehicleState) -> tuple[Vec3, Vec3]:
        """Give rate (rad/s) and force (m/s^2) of a state in S."""
        return cabin_rate(self._parameters.rotation_gain, vehicle), flip(vehicle.f_B)


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
        LOOK_AHEAD,
        HOLD,
    ),
)
