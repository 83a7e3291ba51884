"""The data that flows, one way: VehicleState -> Cue -> Motion -> WheelSpeeds, gathered in one Tick."""

from .felt import STANDARD_GRAVITY, direction_error, felt
from .limits import StageLimits, WheelLimits
from .seams import Sink, Vehicle, WheelDrive
from .states import Cue, Motion, Tick, VehicleState, WheelSpeeds
from .topics import TOPICS, Topic, tick_row

__all__ = [
    "STANDARD_GRAVITY",
    "TOPICS",
    "Cue",
    "Motion",
    "Sink",
    "StageLimits",
    "Tick",
    "Topic",
    "Vehicle",
    "VehicleState",
    "WheelDrive",
    "WheelLimits",
    "WheelSpeeds",
    "direction_error",
    "felt",
    "tick_row",
]
