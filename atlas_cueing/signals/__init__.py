"""The data that flows one way: VehicleState -> Cue -> Motion -> WheelSpeeds, in one Tick."""

from .attitude_jump import attitude_jump
from .felt import STANDARD_GRAVITY, direction_error, felt
from .limits import StageLimits, WheelLimits
from .seams import Sink, Vehicle, WheelDrive
from .state_change import StateChange
from .states import Cue, Motion, Tick, Timing, VehicleState, WheelSpeeds
from .topics import (
    LIVE_ROW,
    LIVE_STATES,
    LIVE_TOPICS,
    ROW,
    TIMING,
    TOPICS,
    Topic,
    live_row,
    tick_row,
)

__all__ = [
    "LIVE_ROW",
    "LIVE_STATES",
    "LIVE_TOPICS",
    "ROW",
    "STANDARD_GRAVITY",
    "TIMING",
    "TOPICS",
    "Cue",
    "Motion",
    "Sink",
    "StageLimits",
    "StateChange",
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
