"""The data that flows, one way: VehicleState -> Cue -> Motion -> WheelSpeeds, gathered in one Tick."""

from .attitude_jump import attitude_jump
from .felt import STANDARD_GRAVITY, direction_error, felt
from .limits import StageLimits, WheelLimits
from .seams import Sink, Vehicle, WheelDrive
from .states import Cue, Motion, Tick, Timing, VehicleState, WheelSpeeds
from .topics import LIVE_STATES, LIVE_TOPICS, TIMING, TOPICS, Topic, live_row, tick_row

__all__ = [
    "LIVE_STATES",
    "LIVE_TOPICS",
    "STANDARD_GRAVITY",
    "TIMING",
    "TOPICS",
    "Cue",
    "Motion",
    "Sink",
    "StageLimits",
    "Tick",
    "Timing",
    "Topic",
    "Vehicle",
    "VehicleState",
    "WheelDrive",
    "WheelLimits",
    "WheelSpeeds",
    "attitude_jump",
    "direction_error",
    "felt",
    "live_row",
    "tick_row",
]
