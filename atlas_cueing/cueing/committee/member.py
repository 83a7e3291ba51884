"""A law of rotation as a virtual cabin beside the vehicle, and what its rider would miss."""

# mypyc: runs every tick

from ...perception import Observer
from ...rotation import ZERO, Vec3, add, conjugate, rotate, scale, subtract, up_in_body
from ...signals import STANDARD_GRAVITY, VehicleState
from ..method import Rotation
from .loss import LossParameters, observer_loss, organs_loss


class Pilot:
    """The vehicle in the cabin's axes, and what its pilot perceives."""

    def __init__(self, dt: float, w_S: Vec3, f_S: Vec3) -> None:
        """Begin with the lasting rate w_S (rad/s) and force f_S (m/s^2); dt in s."""
        self.w_S, self.f_S = w_S, f_S
        self.observer = Observer(dt, f_S, w_S)

    def step(self, w_S: Vec3, f_S: Vec3, observed: bool) -> None:
        """Take in the next tick; without an observer, what is perceived stays as it is."""
        self.w_S, self.f_S = w_S, f_S
        if observed:
            self.observer.step(f_S, w_S)


class Member:
    """One law's cabin: `up` W's up in it, `extra` its rate beyond the vehicle's (rad/s), both in S.

    `felt` is what the canals feel of `extra`, `loss` the loss of this tick.
    """

    def __init__(
        self, dt: float, rotation: Rotation, loss: LossParameters, canals: float, hold: float
    ) -> None:
        """Begin before the first state.

        Args:
            dt: tick, s.
            rotation: the law, new.
            loss: what is lost by how much.
            canals: their time constant, s.
            hold: a force's direction fades below twice this, m/s^2.

        """
        self._dt, self._rotation, self._loss, self._hold = dt, rotation, loss, hold
        self._observed = loss.judge == "observer"
        self._half = 0.5 * dt / canals
        self._rider: Observer | None = None
        self._used_to = ZERO
        self.up, self.extra, self.felt, self.loss = ZERO, ZERO, ZERO, 0.0

    def step(self, vehicle: VehicleState, pilot: Pilot) -> None:
        """Turn the cabin for the next state; `pilot` has taken it in."""
        q_WS, w_WS_W = self._rotation.step(vehicle)
        w_S, before = rotate(conjugate(q_WS), w_WS_W), self.extra
        self.up, self.extra = up_in_body(q_WS), subtract(w_S, pilot.w_S)
        self._feel(before)
        self.loss = organs_loss(self._loss, self.up, self.felt, pilot.f_S, self._hold)
        if self._observed:
            self.loss = 0.5 * (self.loss + self._perceive(w_S, pilot.observer))

    def _feel(self, before: Vec3) -> None:
        """Let the canals feel the extra rate, which was `before` a tick ago, by the trapezoid."""
        half = self._half
        driven = add(scale(1.0 - half, self._used_to), scale(half, add(before, self.extra)))
        self._used_to = scale(1.0 / (1.0 + half), driven)
        self.felt = subtract(self.extra, self._used_to)

    def _perceive(self, w_S: Vec3, pilot: Observer) -> float:
        """Give the loss by what the rider of a cabin that turns with w_S (rad/s, S) perceives."""
        force = scale(STANDARD_GRAVITY, self.up)
        if self._rider is None:
            self._rider = Observer(self._dt, force, w_S)
        else:
            self._rider.step(force, w_S)
        return observer_loss(self._loss, self._rider, pilot)
