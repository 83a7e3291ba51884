"""Method `attitude`: the sphere takes the vehicle's attitude one to one, for ever."""

from ..rotation import IDENTITY, Quat, Vec3, add, conjugate, exp, flip_rotation, log, multiply, normalise, rotate
from ..signals import VehicleState
from .parameters import AttitudeParameters
from .turn import SlowTurn, attitude_jump, body_turn, level_heading, scaled


class AttitudeRotation:
    """q_WS = flip(heading^-1 q_NB): the cabin in W stands as the vehicle in its north-east-down frame.

    With a gain the increments of the attitude are scaled, cabin axis by cabin axis; with gain one they add up to the
    attitude itself. A jump of the attitude is not chased: the cabin goes on with the body rates and takes the rest back
    by the slow turn.
    """

    def __init__(self, dt: float, parameters: AttitudeParameters) -> None:
        """Begin at the first state; dt in s."""
        self._gain, self._jump = parameters.rotation_gain, parameters.jump
        self._turn = SlowTurn(dt, parameters.turn)
        self._before: VehicleState | None = None
        self._target = self._q_WS = IDENTITY

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Orientation q_WS and rate w_WS_W (rad/s) of the cue."""
        if self._before is None:
            self._target = self._q_WS = flip_rotation(multiply(level_heading(vehicle.q_NB), vehicle.q_NB))
        else:
            self._follow(self._before, vehicle)
        self._before = vehicle
        turn, w_slow = self._turn.step(log(multiply(conjugate(self._q_WS), self._target)))
        if any(turn):
            self._q_WS = normalise(multiply(self._q_WS, exp(turn)))
        return self._q_WS, rotate(self._q_WS, add(scaled(self._gain, vehicle.w_NB_B), w_slow))

    def _follow(self, before: VehicleState, now: VehicleState) -> None:
        """Turn target and cue with the vehicle; across a jump only the target takes it."""
        turned = log(multiply(conjugate(before.q_NB), now.q_NB))
        smooth = turned if attitude_jump(before, now) <= self._jump else body_turn(before, now)
        self._target = normalise(multiply(self._target, exp(scaled(self._gain, turned))))
        self._q_WS = normalise(multiply(self._q_WS, exp(scaled(self._gain, smooth))))
