"""Sources of vehicle states; the only place that knows feet, pounds and knots.

A `ScriptFlight` or an `AircraftFlight` says what to fly and `JsbsimVehicle` flies it, as a
`signals.Vehicle`; a `SignalFlight` is flown by a `SignalVehicle`, and a `RecordedVehicle` plays
recorded states back. `flightgear` reads the packets of a simulator elsewhere.
"""

from .bounds import Bounds
from .flightgear import FlightgearFlight
from .flown_ahead import FlownAhead
from .jsbsim.flights import AircraftFlight, InitialConditions, ScriptFlight, TimedInput
from .jsbsim.jsbsim_vehicle import JsbsimVehicle
from .jsbsim.library import own_aircraft, own_scripts, suggestion
from .jsbsim.loading import input_objections
from .recorded_vehicle import RecordedVehicle
from .signal_vehicle import Signal, SignalFlight, SignalVehicle

__all__ = [
    "AircraftFlight",
    "Bounds",
    "FlightgearFlight",
    "FlownAhead",
    "InitialConditions",
    "JsbsimVehicle",
    "RecordedVehicle",
    "ScriptFlight",
    "Signal",
    "SignalFlight",
    "SignalVehicle",
    "TimedInput",
    "input_objections",
    "own_aircraft",
    "own_scripts",
    "suggestion",
]
