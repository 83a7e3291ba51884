"""The MCAP log: written tick by tick, read back as columns."""

from .log import Log, TopicColumns
from .reader import read_log
from .recorder import RUN_METADATA, McapRecorder

__all__ = [
    "RUN_METADATA",
    "Log",
    "McapRecorder",
    "TopicColumns",
    "read_log",
]
