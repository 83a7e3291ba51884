"""The MCAP log of a run: written tick by tick, read back as columns, recovered when broken."""

from .log import Log, TopicColumns
from .reader import read_log, read_metadata
from .recorder import RUN_METADATA, McapRecorder
from .rewriting import rewrite_log
from .vehicle_log import write_vehicle_log

__all__ = [
    "RUN_METADATA",
    "Log",
    "McapRecorder",
    "TopicColumns",
    "read_log",
    "read_metadata",
    "rewrite_log",
    "write_vehicle_log",
]
