"""Vehicle state to cue: what the platform should do, before it is asked whether it can.

A rotation method turns the vehicle into an orientation of the sphere; the stage adds what
acceleration it can. Nothing is ever washed out to neutral.

Each method is one module with its parameters, its rotation and its declaration METHOD; `methods`
has the table of them.
"""

from .attitude import AttitudeParameters
from .blend import BlendParameters
from .cabin import SlowTurnParameters
from .classical import CLASSICAL_STAGE, ClassicalParameters
from .cueing import Cueing, build_cueing
from .felt_turn import FeltTurnParameters
from .force import ForceParameters
from .hedge import HedgeParameters
from .method import (
    CueSource,
    LookAheadParameters,
    Method,
    MethodParameters,
    PlanParameters,
    Rotation,
    RotationParameters,
    needs_flight,
)
from .methods import CAUSAL_METHODS, DEFAULT_METHOD, METHODS
from .perceptual import PerceptualParameters
from .preview import PreviewParameters
from .stage.stage_parameters import MpcParameters, StageParameters
from .still import StillParameters

__all__ = [
    "CAUSAL_METHODS",
    "CLASSICAL_STAGE",
    "DEFAULT_METHOD",
    "METHODS",
    "AttitudeParameters",
    "BlendParameters",
    "ClassicalParameters",
    "CueSource",
    "Cueing",
    "FeltTurnParameters",
    "ForceParameters",
    "HedgeParameters",
    "LookAheadParameters",
    "Method",
    "MethodParameters",
    "MpcParameters",
    "PerceptualParameters",
    "PlanParameters",
    "PreviewParameters",
    "Rotation",
    "RotationParameters",
    "SlowTurnParameters",
    "StageParameters",
    "StillParameters",
    "build_cueing",
    "needs_flight",
]
