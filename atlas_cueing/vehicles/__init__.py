"""Sources of vehicle states; the only place that knows feet, pounds and knots.

Each source is a `Flight`, which knows what it flies and builds its `signals.Vehicle`: a script or
an aircraft in JSBSim, test signals, a free rigid body, a rider on a track, and the packets of a
simulator elsewhere. `RecordedVehicle` plays recorded states back. `LimitedDuration` ends any of
them after the time that is asked for.
"""

from .bounds import Bounds, PacketError
from .flight import Flight
from .flightgear import FlightgearFlight
from .flown_ahead import FlownAhead
from .jsbsim.flights import AircraftFlight, InitialConditions, ScriptFlight, TimedInput
from .jsbsim.jsbsim_vehicle import JsbsimVehicle
from .jsbsim.library import own_aircraft, own_scripts, suggestion
from .jsbsim.loading import input_objections
from .kept_flight import KeptFlight, RememberedVehicle, flight_of_bytes
from .limited_duration import LimitedDuration
from .packets import PacketFlight
from .recorded_vehicle import RecordedVehicle
from .rigid_body import RigidBodyFlight, RigidBodyVehicle
from .signal_shapes import Signal
from .signal_vehicle import SignalFlight, SignalVehicle
from .track import TrackFlight, TrackVehicle
from .track_car import Car

__all__ = [
    "AircraftFlight",
    "Bounds",
    "Car",
    "Flight",
    "FlightgearFlight",
    "FlownAhead",
    "InitialConditions",
    "JsbsimVehicle",
    "KeptFlight",
    "LimitedDuration",
    "PacketError",
    "PacketFlight",
    "RecordedVehicle",
    "RememberedVehicle",
    "RigidBodyFlight",
    "RigidBodyVehicle",
    "ScriptFlight",
    "Signal",
    "SignalFlight",
    "SignalVehicle",
    "TimedInput",
    "TrackFlight",
    "TrackVehicle",
    "flight_of_bytes",
    "input_objections",
    "own_aircraft",
    "own_scripts",
    "suggestion",
]
