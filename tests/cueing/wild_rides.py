"""Vehicles that nothing could be, and the bounds of `hedge` that have to hold for them as well."""

import random
from collections.abc import Iterator
from dataclasses import dataclass
from math import log, pi

import numpy as np

from atlas_cueing.cueing import HedgeParameters, Rotation, StageParameters
from atlas_cueing.cueing.committee.committee import Committee
from atlas_cueing.cueing.committee.weights import WeightParameters, Weights
from atlas_cueing.cueing.method import rotation_of
from atlas_cueing.cueing.stage.stage_cueing import StageCueing
from atlas_cueing.evaluation import BLOCK_TICKS, LimitUse, RunColumns, violations
from atlas_cueing.recording import Log
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    conjugate,
    exp,
    flip,
    norm,
    rotate,
    subtract,
)
from atlas_cueing.scenario import load_platform
from atlas_cueing.signals import TOPICS, Cue, Tick, VehicleState, tick_row
from atlas_cueing.smoothing import Smoothing
from atlas_cueing.wheels import Wheels

from .bilinear_canals import Canals

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


class Overheard:
    """A law that remembers its last cue, so that a committee and a test can ask it at once."""

    def __init__(self, law: Rotation) -> None:
        self._law = law
        self.cue: tuple[Quat, Vec3] = IDENTITY, ZERO

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:
        self.cue = self._law.step(vehicle)
        return self.cue


class CueBound:
    """Rides `hedge` and counts the ticks at which more is felt of its cue than may be.

    Felt by canals of the test's own, of the cue's rate less the vehicle's. Allowed: what the
    members' riders feel by the same canals, each by the member's share, and the bound of the draw.
    """

    def __init__(self, parameters: HedgeParameters, dt: float) -> None:
        self.exceeded, self.fullest = 0, 0.0
        self._turn = parameters.committee.turn
        self._members = [Overheard(rotation_of(law, dt, ())) for law in parameters.members()]
        self._committee = Committee(dt, self._members, parameters.committee)
        self._canals = [Canals(dt) for _ in self._members]
        self._own = Canals(dt)

    def step(self, vehicle: VehicleState) -> Cue:
        """The cue for the next state, looked at; at the first one members are at their start."""
        w_S = flip(vehicle.w_NB_B)
        q_WS, w_W = self._committee.step(vehicle)
        felt = norm(self._own.feel(subtract(rotate(conjugate(q_WS), w_W), w_S)))
        theirs = [
            norm(canals.feel(subtract(rotate(conjugate(member.cue[0]), member.cue[1]), w_S)))
            for member, canals in zip(self._members, self._canals, strict=True)
        ]
        mean = sum(p * y for p, y in zip(self._committee.shares, theirs, strict=True))
        turn = self._turn
        more = turn.felt + turn.rate_gain * norm(w_S) + turn.error_gain * pi
        allowed = mean + min(more, turn.extra)
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


@dataclass(frozen=True, slots=True)
class Findings:
    """What a wild ride found: ticks beyond a bound, and how near to one it came."""

    ticks: int
    felt_exceeded: int
    fullest: float
    loss_exceeded: int
    violations: tuple[str, ...]
    use: float


def ride(seed: int, ticks: int, parameters: HedgeParameters | None = None) -> Findings:
    """Ride wild states at 120 Hz on the 2.9 m sphere, with smoothing and wheels behind."""
    dt, law = 1.0 / 120.0, parameters or HedgeParameters()
    platform = load_platform("atlas-2.9m")
    limits = platform.wheel_limit_values(), platform.stage_limit_values()
    wheels = Wheels(platform.geometry())
    smoothing = Smoothing(
        dt=dt,
        wheels_from_sphere=wheels.wheels_from_sphere,
        sphere_from_wheels=wheels.sphere_from_wheels,
        wheel_limits=limits[0],
        stage_limits=limits[1],
    )
    bound, regret = CueBound(law, dt), Regret(dt, len(law.members()))
    stage = StageCueing(dt, StageParameters(), limits[1], platform.head_S)
    use = LimitUse(*limits)
    rows: list[tuple[float, ...]] = []
    for vehicle in wild_states(seed, ticks, dt):
        cue = bound.step(vehicle)
        regret.step(bound.losses)
        p, v, a = stage.step(cue.q_WS, cue.w_WS_W, vehicle.f_B)
        motion = smoothing.step(Cue(vehicle.time, cue.q_WS, cue.w_WS_W, p, v, a))
        rows.append(tick_row(Tick(vehicle, cue, motion, wheels.speeds(motion))))
        if len(rows) == BLOCK_TICKS:
            use.add(_columns(rows))
            rows = []
    if rows:
        use.add(_columns(rows))
    figures = use.figures()
    return Findings(
        ticks,
        bound.exceeded,
        bound.fullest,
        regret.exceeded,
        tuple(violations(figures)),
        max(figures.values()),
    )


def _columns(rows: list[tuple[float, ...]]) -> RunColumns:
    """The rows as a run's columns; what is felt does not matter here."""
    whole = np.zeros((len(rows), sum(len(topic.fields) for topic in TOPICS)))
    whole[:, : len(rows[0])] = rows
    return RunColumns.of(Log.of_ticks(whole))
