"""A rotation method and the stage, side by side."""

# mypyc: runs every tick

from collections.abc import Sequence

from ..rotation import Vec3
from ..signals import Cue, StageLimits, VehicleState
from .method import LookAheadParameters, Rotation, RotationParameters, rotation_of
from .stage.stage_cueing import StageCueing
from .stage.stage_parameters import StageParameters


class Cueing:
    """Turns vehicle states into cues, at a fixed tick.

    States are believable ones, as `vehicles` lets through (`Bounds`): finite, and far from
    overflow.
    """

    def __init__(self, rotation: Rotation, stage: StageCueing) -> None:
        """Begin at the first state."""
        self._rotation, self._stage = rotation, stage

    def step(self, vehicle: VehicleState) -> Cue:
        """Give the cue for the next vehicle state."""
        q_WS, w_WS_W = self._rotation.step(vehicle)
        p_WS_W, v_WS_W, a_WS_W = self._stage.step(q_WS, w_WS_W, vehicle.f_B)
        return Cue(vehicle.time, q_WS, w_WS_W, p_WS_W, v_WS_W, a_WS_W)


def build_cueing(
    method: RotationParameters | LookAheadParameters,
    stage: StageParameters,
    limits: StageLimits,
    head_S: Vec3,
    dt: float,
    flight: Sequence[VehicleState] = (),
) -> Cueing:
    """Make the cueing of a causal method, which begins at the first state.

    Args:
        method: parameters of the method; they make its rotation.
        stage: parameters of the stage.
        limits: what the platform's stage can do.
        head_S: the rider's head from the sphere's centre, m, in S.
        dt: time step, s.
        flight: every state of the flight, dt apart, for a method that looks ahead.

    Raises InputError for look-ahead without a flight.

    """
    return Cueing(rotation_of(method, dt, flight), StageCueing(dt, stage, limits, head_S))
