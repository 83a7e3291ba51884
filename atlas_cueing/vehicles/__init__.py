"""Sources of vehicle states; the only place that knows feet, pounds and knots.

A `ScriptFlight` or an `AircraftFlight` says what to fly and `JsbsimVehicle` flies it, as a `signals.Vehicle`.
"""

from .bounds import Bounds
from .flights import AircraftFlight, InitialConditions, ScriptFlight, TimedInput
from .jsbsim_vehicle import JsbsimVehicle
from .library import own_aircraft, own_scripts, suggestion

__all__ = [
    "AircraftFlight",
    "Bounds",
    "InitialConditions",
    "JsbsimVehicle",
    "ScriptFlight",
    "TimedInput",
    "own_aircraft",
    "own_scripts",
    "suggestion",
]
