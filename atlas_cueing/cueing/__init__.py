"""Vehicle state to cue: what the platform should do, before anyone asks whether it can.

A rotation method turns the vehicle into an orientation of the sphere; the stage adds what
acceleration it can. Nothing is ever washed out to neutral.
"""

from .cueing import Cueing, CueSource, RotationMethod, build_cueing
from .parameters import (
    CLASSICAL_STAGE,
    AttitudeParameters,
    BlendParameters,
    ClassicalParameters,
    ForceParameters,
    HorizonParameters,
    MethodParameters,
    PreviewParameters,
    SlowTurnParameters,
    StageParameters,
)

__all__ = [
    "CLASSICAL_STAGE",
    "AttitudeParameters",
    "BlendParameters",
    "ClassicalParameters",
    "CueSource",
    "Cueing",
    "ForceParameters",
    "HorizonParameters",
    "MethodParameters",
    "PreviewParameters",
    "RotationMethod",
    "SlowTurnParameters",
    "StageParameters",
    "build_cueing",
]
