"""The keys that the `[vehicle]` tables of all sources of packets have."""

from ipaddress import AddressValueError, IPv4Address
from typing import Annotated, Any

from pydantic import BeforeValidator

from ..vehicles.sent_flight import LOOPBACK
from .tables import ScenarioTable, number, refuse, says, whole


def _loopback(value: Any) -> str:
    try:
        if isinstance(value, str) and IPv4Address(value).is_loopback:
            return value
    except AddressValueError:
        pass
    raise refuse(
        f"{LOOPBACK!r} or another loopback address; for packets of other machines: live --listen"
    )


class PacketPort(ScenarioTable):
    """Where packets come in, and how many a second, nominally.

    After `hold_after_s` without a good packet the platform holds.
    """

    rate_hz: Annotated[
        Annotated[float, number(10.0, 1000.0)] | None,
        says("ticks a second, to which packets are brought"),
    ] = None
    host: Annotated[
        Annotated[str, BeforeValidator(_loopback)] | None, says("address that packets come to")
    ] = None
    port: Annotated[
        Annotated[int, whole(1, 65535)] | None, says("UDP port that packets come to")
    ] = None
    hold_after_s: Annotated[
        Annotated[float, number(0.05, 1.0)] | None, says("silence after which the cabin is held")
    ] = None
