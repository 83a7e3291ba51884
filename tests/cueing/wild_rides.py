"""Vehicles that nothing could be, and the bounds of `hedge` that have to hold for them as well."""

import random
from collections.abc import Iterator
from math import log, pi

from atlas_cueing.cueing import HedgeParameters
from atlas_cueing.cueing.committee.weights import WeightParameters, Weights
from atlas_cueing.rotation import Vec3, conjugate, exp, flip, norm, rotate, subtract
from atlas_cueing.signals import Cue, VehicleState

from .test_felt_turn import Canals

REGRET_ETA = 0.1


def wild_states(seed: int, ticks: int, dt: float) -> Iterator[VehicleState]:
    """Attitudes, rates and forces of any size that jump, stand for a while, and drift."""
    randomly = random.Random(seed)
    count = 0
    while count < ticks:
        q_NB = exp(_vector(randomly, 3.0))
        w, f = (_vector(randomly, 10.0 ** randomly.uniform(-3.0, top)) for top in (1.7, 2.7))
        dw, df = (_vector(randomly, 10.0 ** randomly.uniform(-6.0, 0.0)) for _ in range(2))
        if randomly.random() < 0.1:
            f = (0.0, 0.0, 0.0)
        for _ in range(min(randomly.choice((1, 3, 30, 600)), ticks - count)):
            w, f = subtract(w, dw), subtract(f, df)
            yield VehicleState(count * dt, q_NB, w, f)
            count += 1


def _vector(randomly: random.Random, size: float) -> Vec3:
    return (
        randomly.uniform(-size, size),
        randomly.uniform(-size, size),
        randomly.uniform(-size, size),
    )


class CueBound:
    """Rides `hedge` and counts the ticks at which more is felt of its cue than may be.

    Felt by canals of the test's own, of the cue's rate less the vehicle's. Allowed: what the most
    of the members' riders feels, by the same canals, and the bound of the draw.
    """

    def __init__(self, parameters: HedgeParameters, dt: float) -> None:
        self.exceeded, self.fullest = 0, 0.0
        self._turn = parameters.committee.turn
        self._committee = parameters.rotation(dt)
        self._members = [law.rotation(dt) for law in parameters.members()]
        self._canals = [Canals(dt) for _ in self._members]
        self._own = Canals(dt)
        self._first = True

    def step(self, vehicle: VehicleState) -> Cue:
        """The cue for the next state, looked at; at the first one members are at their start."""
        w_S = flip(vehicle.w_NB_B)
        q_WS, w_W = self._committee.step(vehicle)
        felt = norm(self._own.feel(subtract(rotate(conjugate(q_WS), w_W), w_S)))
        most = max(
            norm(canals.feel(subtract(rotate(conjugate(q), w), w_S)))
            for (q, w), canals in zip(
                (member.step(vehicle) for member in self._members), self._canals, strict=True
            )
        )
        turn = self._turn
        more = turn.felt + turn.rate_gain * norm(w_S) + turn.error_gain * pi
        allowed = most + min(more, turn.extra)
        self.fullest = max(self.fullest, felt / allowed)
        self.exceeded += felt > allowed * (1.0 + 1e-9) + 1e-9
        return Cue(vehicle.time, q_WS, w_W, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

    @property
    def losses(self) -> list[float]:
        """The members' losses in the last tick."""
        return list(self._committee._losses)


class Regret:
    """Exponential weights with a constant eta on the losses, and how they compare with the best."""

    def __init__(self, dt: float, members: int) -> None:
        self.parameters = WeightParameters(contrast=REGRET_ETA * 1e15, floor=1e15)
        self._late = self.parameters.memory / dt
        self._start = [0.0, *([100.0] * (members - 1))]
        self._weights = Weights(dt, self.parameters, self._start)
        self._whole, self._each, self._ticks = 0.0, [0.0] * members, 0
        self.exceeded = 0

    def step(self, losses: list[float]) -> None:
        """Take in the losses of a tick, and look at the bound up to it."""
        self._weights.step(losses)
        self._ticks += 1
        shares = self._weights.shares
        self._whole += sum(p * loss for p, loss in zip(shares, losses, strict=True))
        spread = (self._ticks + self._late) * log(len(losses)) / REGRET_ETA
        for i, loss in enumerate(losses):
            self._each[i] += loss
        bound = min(
            each + spread + self._late * start
            for each, start in zip(self._each, self._start, strict=True)
        )
        self.exceeded += self._whole > bound * (1.0 + 1e-6)
