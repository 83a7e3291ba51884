"""Forces, torques and power of a motion, and whether the contacts can give them.

The sphere is one rigid body on wheels that drive it, with constant preloads and passive supports
if there are any. Equation numbers are those of the module docstrings:

| equation | where |
|---|---|
| (1) moment, (2) force | `balance.required_wrench` |
| (3) drive forces, (4) wheel torques | `balance.balance`, `balance.wheel_torques` |
| (5) torques at rest | `reserve.static_torques` |
| (6) wheel-space inertia | `reserve.wheel_space_inertia` |
| (7) normal forces | `normal_forces` |
| (8) traction use, (9) preload needed | `balance.traction_use`, `balance.preload_needed` |
| (10), (11) double-row wheels | `wheels.rows` |
"""

from .balance import LARGEST_USE, Loads, balance, platform_loads
from .body import Body, Part, body_of, inertia_tensor, is_realizable
from .columns import load_columns
from .contact import UNLIMITED, Drive, Preload, Support, WheelContact
from .kept_rows import KeptRows
from .least_use import least_use_drive
from .model import LoadModel
from .reserve import Reserve, reserve
from .tick_loads import TickLoads, WheelLoads

__all__ = [
    "LARGEST_USE",
    "UNLIMITED",
    "Body",
    "Drive",
    "KeptRows",
    "LoadModel",
    "Loads",
    "Part",
    "Preload",
    "Reserve",
    "Support",
    "TickLoads",
    "WheelContact",
    "WheelLoads",
    "balance",
    "body_of",
    "inertia_tensor",
    "is_realizable",
    "least_use_drive",
    "load_columns",
    "platform_loads",
    "reserve",
]
