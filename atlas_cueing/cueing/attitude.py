"""Method `attitude`: the sphere takes the vehicle's attitude one to one, for ever."""

# mypyc: runs every tick

from dataclasses import dataclass

from ..rotation import IDENTITY, Quat, Vec3, conjugate, exp, log, multiply, normalise
from ..signals import VehicleState
from .cabin import SLOW_TURN, Cabin, SlowTurnParameters, cabin_rate, slow_turn, upright
from .method import Method
from .parameter import ONES, Parameter
from .stage.stage_parameters import GAIN


@dataclass(frozen=True, slots=True)
class AttitudeParameters:
    """Parameters of `attitude`; METHOD says what each is.

    turn: takes back what the body rates leave to the attitude, above all after a jump.
    """

    rotation_gain: Vec3 = ONES
    turn: SlowTurnParameters = SLOW_TURN

    def rotation(self, dt: float) -> "AttitudeRotation":
        """Make the rotation that begins at the first state; dt in s."""
        return AttitudeRotation(dt, self)


class AttitudeRotation:
    """The cabin stands in W as the vehicle does in N: q_WS = flip(heading^-1 q_NB).

    It turns with the vehicle's body rates, and the slow turn takes back what is then left to the
    attitude itself. In flight that is next to nothing (JSBSim's attitude lags its rates by half a
    step, at most dt/2 |w|); after a reset or a trim in mid-run it is the jump, which is never
    chased. With a gain the increments of the attitude are scaled, cabin axis by cabin axis; with
    gain one they add up to the attitude.
    """

    def __init__(self, dt: float, parameters: AttitudeParameters) -> None:
        """Begin at the first state, in the vehicle's attitude; dt in s."""
        self._dt, self._parameters = dt, parameters
        self._cabin: Cabin | None = None
        self._q_NB, self._target = IDENTITY, IDENTITY

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state."""
        w_S = cabin_rate(self._parameters.rotation_gain, vehicle)
        if self._cabin is None:
            self._target = upright(vehicle.q_NB)
            self._cabin = Cabin(self._dt, self._target, w_S, self._parameters.turn)
        else:
            self._target = normalise(multiply(self._target, self._turned(vehicle.q_NB)))
            self._cabin.carry(w_S)
            self._cabin.correct(log(multiply(conjugate(self._cabin.q_WS), self._target)))
        self._q_NB = vehicle.q_NB
        return self._cabin.cue

    def _turned(self, q_NB: Quat) -> Quat:
        """Give the vehicle's turn since the last state, in cabin axes and with the gain."""
        x, y, z = log(multiply(conjugate(self._q_NB), q_NB))
        gain = self._parameters.rotation_gain
        return exp((gain[0] * x, -gain[1] * y, -gain[2] * z))


METHOD = Method(
    "attitude",
    "the sphere takes the vehicle's attitude, for ever",
    AttitudeParameters(),
    (
        Parameter(
            "rotation_gain",
            "rotation_gain",
            GAIN,
            "factor on the vehicle's turn about the cabin's x, y, z",
            "one to one",
        ),
        *slow_turn("return", 90.0),
    ),
)
