"""The MCAP log: written tick by tick, read back as columns."""

from .live import LiveWriter, live_ring
from .log import Log, Status, Table
from .reader import read_log
from .recorder import RUN_METADATA, McapRecorder
from .ring import Ring, RingReader

__all__ = [
    "RUN_METADATA",
    "LiveWriter",
    "Log",
    "McapRecorder",
    "Ring",
    "RingReader",
    "Status",
    "Table",
    "live_ring",
    "read_log",
]
