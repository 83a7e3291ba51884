"""The `[vehicle]` table of a simulator that sends FlightGear's packets."""

from pathlib import Path
from typing import Annotated, Literal

from ..vehicles import FlightgearFlight
from ..vehicles.flightgear import DEFAULT_PORT
from ..vehicles.sent_flight import DEFAULT_HOLD_AFTER, DEFAULT_RATE_HZ, LOOPBACK
from .packet_port import PacketPort
from .source_table import SourceTable
from .tables import says


class FlightgearTable(PacketPort, SourceTable):
    """`[vehicle]` of FlightGear's packets."""

    source: Annotated[Literal["flightgear"], says("takes FlightGear's packets, live")] = (
        "flightgear"
    )

    def flight(self, folder: Path) -> FlightgearFlight:
        """Return where to listen."""
        _ = folder
        return FlightgearFlight(
            self.host or LOOPBACK,
            self.port or DEFAULT_PORT,
            self.rate_hz or DEFAULT_RATE_HZ,
            self.hold_after_s or DEFAULT_HOLD_AFTER,
        )
