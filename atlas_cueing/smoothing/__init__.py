"""Cue to motion: what the platform may do, inside every actuator limit, for any input.

Ruckig proposes a step for each wheel and each stage axis; a step is flown only if a closed-form
stop from where it leads stays inside every limit (`stop`). Otherwise the stop that was certified
one tick ago is flown. Nothing here looks ahead of the cue, and a feasible cue passes unchanged.
"""

from .axis import AxisSmoothing
from .smoothing import Smoothing
from .sphere import SphereSmoothing
from .stage import StageSmoothing
from .stop import Stop

__all__ = [
    "AxisSmoothing",
    "Smoothing",
    "SphereSmoothing",
    "StageSmoothing",
    "Stop",
]
