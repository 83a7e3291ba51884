"""TO WRITE."""

from .messages import LiveWriter, live_ring
from .ring import Ring, RingReader

__all__ = [
    "LiveWriter",
    "Ring",
    "RingReader",
    "live_ring",
]
