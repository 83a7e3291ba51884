"""Laws beside each other, and a cabin that keeps with the mean of theirs."""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass

from ...rotation import ZERO, Quat, Vec3, add, cross, flip, norm, scale, up_in_body
from ...signals import VehicleState
from ..cabin import FreeCabin, cabin_rate
from ..felt_turn import FeltTurnParameters
from ..method import Rotation
from ..parameter import ONES
from ..tilt import aligned
from .draw import DRAW, Draw, turn_to
from .loss import LOSS, LossParameters
from .member import Member, Pilot
from .weights import WEIGHTS, WeightParameters, Weights


@dataclass(frozen=True, slots=True)
class CommitteeParameters:
    """Parameters of a committee.

    rotation_gain: on the vehicle's rates about the cabin's axes, as its members have it.
    hold: the force counts fully from twice this magnitude on, and has no direction below it, m/s^2.
    turn: the turn to the members' mean, and canals and decay as the members know them.
    loss, weights: what is lost by how much, and how that makes shares.
    """

    rotation_gain: Vec3 = ONES
    hold: float = 1.5
    turn: FeltTurnParameters = DRAW
    loss: LossParameters = LOSS
    weights: WeightParameters = WEIGHTS


COMMITTEE = CommitteeParameters()

_LARGEST_FORCE = 1e6  # m/s^2; far beyond any vehicle


class Committee:
    """A rotation that runs several others as virtual cabins, and turns with their weighted mean.

    The members begin together at the first state, the first of them trusted. Nothing switches: ups
    and rates are weighted means, and the weights are smooth functions of losses of late.
    """

    def __init__(
        self, dt: float, laws: Sequence[Rotation], parameters: CommitteeParameters
    ) -> None:
        """Begin at the first state, aligned with its force.

        Args:
            dt: tick, s.
            laws: the rotations of the members, new.
            parameters: of the committee.

        """
        self._dt, self._parameters = dt, parameters
        self._members = [
            Member(dt, law, parameters.loss, parameters.turn.canals, parameters.hold)
            for law in laws
        ]
        start = [0.0, *([parameters.weights.start] * (len(laws) - 1))]
        self._weights = Weights(dt, parameters.weights, start)
        self._losses = [0.0 for _ in laws]
        self._draw = Draw(dt, parameters.turn)
        self._observed = parameters.loss.judge == "observer"
        self._parts: tuple[FreeCabin, Pilot] | None = None

    @property
    def shares(self) -> tuple[float, ...]:
        """Shares of the members in the last tick, which sum to 1."""
        return tuple(self._weights.shares)

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        """Give orientation q_WS and rate w_WS_W (rad/s) of the cue for the next vehicle state."""
        w_S = cabin_rate(self._parameters.rotation_gain, vehicle)
        f_S = _bounded(flip(vehicle.f_B))
        if self._parts is None:
            self._parts = self._begin(vehicle, w_S, f_S)
            self._ask(vehicle, self._parts[1])
            return self._parts[0].cue
        cabin, pilot = self._parts
        pilot.step(w_S, f_S, self._observed)
        self._ask(vehicle, pilot)
        cabin.carry(w_S)
        cabin.turn(self._follow(up_in_body(cabin.q_WS), w_S))
        return cabin.cue

    def _begin(self, vehicle: VehicleState, w_S: Vec3, f_S: Vec3) -> tuple[FreeCabin, Pilot]:
        cabin = FreeCabin(self._dt, aligned(vehicle, self._parameters.hold), w_S)
        return cabin, Pilot(self._dt, w_S, f_S)

    def _ask(self, vehicle: VehicleState, pilot: Pilot) -> None:
        """Let every member take in the next state, and weigh them anew."""
        for i in range(len(self._members)):
            member = self._members[i]
            member.step(vehicle, pilot)
            self._losses[i] = member.loss
        self._weights.step(self._losses)

    def _follow(self, up_S: Vec3, w_S: Vec3) -> Vec3:
        """Give the extra rate (rad/s, S) that keeps with the members' mean."""
        up, extra, felt = ZERO, ZERO, 0.0
        for i in range(len(self._members)):
            share, member = self._weights.shares[i], self._members[i]
            up = add(up, scale(share, member.up))
            extra = add(extra, scale(share, member.extra))
            felt += share * norm(member.felt)
        # where up will be at the end of the tick, of which the cabin has made the vehicle's part
        ahead = add(up_S, scale(self._dt, cross(up_S, self._draw.extra)))
        return self._draw.step(turn_to(up, ahead), extra, felt, w_S)


def _bounded(f_S: Vec3) -> Vec3:
    """Give the force, no larger than _LARGEST_FORCE: the square of a loss has to stay finite."""
    size = norm(f_S)
    return f_S if size <= _LARGEST_FORCE else scale(_LARGEST_FORCE, scale(1.0 / size, f_S))
