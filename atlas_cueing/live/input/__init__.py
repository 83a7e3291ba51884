"""Sources: where the vehicle comes from in real time."""

from .flightgear_source import FlightgearSource
from .source import Source, SourceReading, no_vehicle
from .udp import Datagram, Receiver, UdpReceiver
from .vehicle_source import VehicleSource

__all__ = [
    "Datagram",
    "FlightgearSource",
    "Receiver",
    "Source",
    "SourceReading",
    "UdpReceiver",
    "VehicleSource",
    "no_vehicle",
]
