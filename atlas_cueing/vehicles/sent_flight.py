"""A flight that another program flies, and sends here packet by packet."""

from dataclasses import dataclass
from typing import ClassVar

from ..errors import InputError
from ..signals import Vehicle
from .flight import Flight

LOOPBACK = "127.0.0.1"
DEFAULT_RATE_HZ = 120.0  # JSBSim's own step in FlightGear
# s without a packet that are borne: FlightGear on a busy machine leaves up to 0.28 s (measured)
DEFAULT_HOLD_AFTER = 0.3


@dataclass(frozen=True, slots=True)
class SentFlight(Flight):
    """A vehicle that a simulator elsewhere flies, which owns its time.

    host, port: local address and UDP port that packets come to.
    rate_hz: nominal packets per second; what the sender really sends is measured.
    hold_after: time without a good packet from which on the platform holds, s.
    """

    live_only: ClassVar[str]
    ends_itself: ClassVar[bool] = False

    host: str = LOOPBACK
    port: int = 0
    rate_hz: float = DEFAULT_RATE_HZ
    hold_after: float = DEFAULT_HOLD_AFTER

    def vehicle(self) -> Vehicle:
        """Raise InputError: it cannot be stepped."""
        raise InputError(self.live_only)

    def length(self) -> None:
        """Return nothing: the simulator may send for ever."""

    def step(self) -> float:
        """Return the nominal time between two packets, s."""
        return 1.0 / self.rate_hz
