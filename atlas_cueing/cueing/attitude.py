"""Method `attitude`: the sphere takes the vehicle's attitude one to one, for ever."""

# mypyc: runs every tick

from ..rotation import IDENTITY, Quat, Vec3, conjugate, exp, log, multiply, normalise
from ..signals import VehicleState
from .cabin import Cabin, cabin_rate, upright
from .parameters import AttitudeParameters


class AttitudeRotation:
    """The cabin stands in W as the vehicle in its north-east-down frame: q_WS = flip(heading^-1 q_NB).

    It turns with the vehicle's body rates, and the slow turn takes back whatever is then left to
    the attitude itself. In flight that is next to nothing (JSBSim's attitude lags its rates by half a step, at most dt/2 |w|); after a reset or a trim
    in mid-run it is the jump, which is never chased. With a gain the increments of the attitude are
    scaled, cabin axis by cabin axis; with gain one they add up to the attitude.
    """

    def __init__(self, dt: float, parameters: AttitudeParameters) -> None:
        """Begin at the first state, in the vehicle's attitude; dt in s."""
        self._dt, self._parameters = dt, parameters
        self._cabin: Cabin | None = None
        self._q_NB, self._target = IDENTITY, IDENTITY

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Orientation q_WS and rate w_WS_W (rad/s) of the cue."""
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
        """Turn of the vehicle since the last state, in cabin axes and with the gain."""
        x, y, z = log(multiply(conjugate(self._q_NB), q_NB))
        gain = self._parameters.rotation_gain
        return exp((gain[0] * x, -gain[1] * y, -gain[2] * z))
