"""Sources: where the vehicle comes from in real time."""

from .packet_source import PacketSource, PacketStream
from .source import Source, SourceReading, no_vehicle
from .udp import Datagram, Receiver, UdpReceiver
from .vehicle_source import VehicleSource

__all__ = [
    "Datagram",
    "PacketSource",
    "PacketStream",
    "Receiver",
    "Source",
    "SourceReading",
    "UdpReceiver",
    "VehicleSource",
    "no_vehicle",
]
