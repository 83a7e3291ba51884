"""A rotation method and the stage, side by side."""

# mypyc: runs every tick

from typing import Protocol, TypeAlias

from ..rotation import Vec3
from ..signals import Cue, StageLimits, VehicleState
from .attitude import AttitudeRotation
from .blend import BlendRotation
from .classical import ClassicalRotation
from .force import ForceRotation
from .parameters import (
    AttitudeParameters,
    BlendParameters,
    ClassicalParameters,
    ForceParameters,
    MethodParameters,
    StageParameters,
)
from .stage.stage_cueing import StageCueing

RotationMethod: TypeAlias = AttitudeRotation | BlendRotation | ClassicalRotation | ForceRotation
"""How the sphere follows the vehicle: `step` gives orientation q_WS and rate w_WS_W (rad/s) for a
    vehicle state."""


class CueSource(Protocol):
    """Whatever gives a flight's cues in order: `Cueing` as it goes along, or a plan made for the whole flight."""

    def step(self, vehicle: VehicleState) -> Cue:
        """Cue for this vehicle state."""


class Cueing:
    """Turns vehicle states into cues, at a fixed tick.

    States are believable ones, as `vehicles` lets through (`Bounds`): finite, and far from
    overflow.
    """

    def __init__(self, rotation: RotationMethod, stage: StageCueing) -> None:
        """Begin at the first state."""
        self._rotation, self._stage = rotation, stage

    def step(self, vehicle: VehicleState) -> Cue:
        """Cue for this vehicle state."""
        q_WS, w_WS_W = self._rotation.step(vehicle)
        p_WS_W, v_WS_W, a_WS_W = self._stage.step(q_WS, w_WS_W, vehicle.f_B)
        return Cue(vehicle.time, q_WS, w_WS_W, p_WS_W, v_WS_W, a_WS_W)


def build_cueing(
    method: MethodParameters, stage: StageParameters, limits: StageLimits, head_S: Vec3, dt: float
) -> Cueing:
    """Cueing by the method whose parameters are given.

    Limits and head_S (m, S) of the platform, dt in s.
    """
    rotation: RotationMethod
    match method:
        case AttitudeParameters():
            rotation = AttitudeRotation(dt, method)
        case BlendParameters():
            rotation = BlendRotation(dt, method)
        case ForceParameters():
            rotation = ForceRotation(dt, method)
        case ClassicalParameters():
            rotation = ClassicalRotation(dt, method)
    return Cueing(rotation, StageCueing(dt, stage, limits, head_S))
