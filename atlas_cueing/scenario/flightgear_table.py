"""The `[vehicle]` table of a simulator that sends FlightGear's packets."""

from ipaddress import AddressValueError, IPv4Address
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator

from ..vehicles import FlightgearFlight
from ..vehicles.flightgear import DEFAULT_HOLD_AFTER, DEFAULT_PORT, DEFAULT_RATE_HZ, LOOPBACK
from .source_table import SourceTable
from .tables import number, refuse, whole


def _loopback(value: Any) -> str:
    try:
        if isinstance(value, str) and IPv4Address(value).is_loopback:
            return value
    except AddressValueError:
        pass
    raise refuse(
        f"{LOOPBACK!r} or another loopback address; packets from other machines are not taken yet"
    )


class FlightgearTable(SourceTable):
    """`[vehicle]` of FlightGear: where packets come in, and how many a second, nominally.

    After `hold_after_s` without a good packet the platform holds.
    """

    source: Literal["flightgear"] = "flightgear"
    rate_hz: Annotated[float, number(10.0, 1000.0)] | None = None
    host: Annotated[str, BeforeValidator(_loopback)] | None = None
    port: Annotated[int, whole(1, 65535)] | None = None
    hold_after_s: Annotated[float, number(0.05, 1.0)] | None = None

    def flight(self, folder: Path) -> FlightgearFlight:
        """Return where to listen."""
        _ = folder
        return FlightgearFlight(
            self.host or LOOPBACK,
            self.port or DEFAULT_PORT,
            self.rate_hz or DEFAULT_RATE_HZ,
            self.hold_after_s or DEFAULT_HOLD_AFTER,
        )
