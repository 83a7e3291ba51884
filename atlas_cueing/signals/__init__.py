"""The data that flows one way: VehicleState -> Cue -> Motion -> WheelSpeeds, in one Tick."""

from .attitude_jump import attitude_jump
from .felt import STANDARD_GRAVITY, direction_error, felt
from .limits import StageLimits, WheelLimits
from .load_columns import LoadColumns
from .seams import ContactRows, Sink, Vehicle, WheelDrive
from .state_change import StateChange
from .states import Cue, Motion, Tick, Timing, VehicleState, WheelSpeeds
from .topics import (
    ALL_TOPICS,
    ATTITUDE_ROW,
    CORRECTION,
    ESTIMATE,
    LIVE_ROW,
    LIVE_STATES,
    LIVE_TOPICS,
    LOADS,
    PLANT,
    ROW,
    TIMING,
    TOPICS,
    Topic,
    live_row,
    tick_row,
)

__all__ = [
    "ALL_TOPICS",
    "ATTITUDE_ROW",
    "CORRECTION",
    "ESTIMATE",
    "LIVE_ROW",
    "LIVE_STATES",
    "LIVE_TOPICS",
    "LOADS",
    "PLANT",
    "ROW",
    "STANDARD_GRAVITY",
    "TIMING",
    "TOPICS",
    "ContactRows",
    "Cue",
    "LoadColumns",
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
