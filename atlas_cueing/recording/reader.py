"""Reads a complete log back as columns, whole chunks at a time."""

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from google.protobuf.message import DecodeError
from mcap.exceptions import McapError
from mcap.records import (
    Attachment,
    Channel,
    Chunk,
    DataEnd,
    Header,
    McapRecord,
    Metadata,
    Schema,
    Statistics,
)

from ..errors import LogError
from .builder import LogBuilder
from .compression import unpack
from .log import Log
from .message_starts import MESSAGE_HEAD, Starts
from .recorder import RUN_METADATA
from .records import LooseMessage, MessageOffsets, RecordReader
from .wire import RECORD_HEAD

MAX_LOG = 4 * 2**30  # bytes of messages unpacked; over an hour at 1 kHz
_HEAD = MESSAGE_HEAD + RECORD_HEAD  # bytes before the body of a message record
_LOOSE = 2**20  # bytes of messages outside of chunks that are read at a time


def read_log(path: str | Path, max_bytes: int = MAX_LOG) -> Log:
    """Read a complete log of this program's topics into memory.

    Args:
        path: a log as `McapRecorder` writes it, or a valid MCAP file of its topics by any other
            writer; topics and fields may have been added.
        max_bytes: bound on the unpacked messages; about half of it is kept in memory.

    Raises LogError when the file cannot be read, is cut or damaged (every checksum is checked), has
    none of this program's topics, or none of the messages of such a topic can be read.

    Example:
        >>> from atlas_cueing import load_scenario, read_log, run_scenario
        >>> scenario = load_scenario("scenarios/signal_sway.toml", ["duration_s=1"])
        >>> log = read_log(run_scenario(scenario, "sway.mcap").log)
        >>> [*log.tables]
        ['/vehicle', '/cue', '/motion', '/wheels', '/felt', '/loads']
        >>> log.vector("/motion", "w").shape  # rad/s in W, a row a tick
        (121, 3)
        >>> float(log.columns("/wheels")["time_s"][-1])
        1.0

    """
    path = Path(path)
    with errors_of_reading(path), path.open("rb") as stream:
        content = _Content(path, max_bytes)
        for record in RecordReader(stream).records():
            content.add(record)
        return content.log()


def read_metadata(path: str | Path) -> dict[str, str]:
    """Read the metadata of a run alone; empty where a log has none. Raises LogError."""
    path, found = Path(path), dict[str, str]()
    with errors_of_reading(path), path.open("rb") as stream:
        for record in RecordReader(stream).records():
            if isinstance(record, Metadata) and record.name == RUN_METADATA:
                found = dict(record.metadata)
    return found


@contextmanager
def errors_of_reading(path: Path) -> Iterator[None]:
    """Turn every error of reading into a LogError of one line that names the file."""
    try:
        yield
    except LogError as error:
        raise LogError(f"{path}: {error}") from error
    except OSError as error:
        raise LogError(f"{path}: cannot be read: {error.strerror}") from error
    except (
        McapError,
        DecodeError,
        struct.error,
        ValueError,
        KeyError,
        TypeError,
        AttributeError,
        OverflowError,
    ) as error:
        # protobuf's may have several lines
        evidence = " ".join(str(error).split()) or type(error).__name__
        raise LogError(f"{path}: the log is damaged: {evidence}") from error


class _Content:
    """The content of a log up to the present record."""

    def __init__(self, path: Path, max_bytes: int) -> None:
        self._builder = LogBuilder(path, max_bytes)
        self._chunk: Chunk | None = None  # kept until its index has come
        self._index: Starts = {}
        # messages outside of chunks, until there are many or another record comes
        self._loose = bytearray()

    def add(self, record: McapRecord | MessageOffsets | LooseMessage) -> None:
        """Keep one record of the data section; the summary repeats what is known."""
        if isinstance(record, MessageOffsets):
            self._keep_index(record)
            return
        self._finish_chunk()
        if isinstance(record, LooseMessage):
            self._keep_loose(record.record)
            return
        self._finish_loose()
        builder = self._builder
        match record:
            case Header():
                builder.library = record.library
            case Schema():
                builder.charge(len(record.data))
                builder.add_schema(record)
            case Channel():
                builder.add_channel(record)
            case Chunk():
                builder.charge(record.uncompressed_size)
                self._chunk = record
            case Attachment():
                builder.charge(len(record.data))
                builder.add_attachment(record.name, record.data)
            case Metadata():
                builder.add_metadata(record.name, record.metadata)
            case DataEnd():
                builder.data_checked = record.data_section_crc != 0
            case Statistics():
                builder.check_counts(record.channel_message_counts)

    def log(self) -> Log:
        """Return the log, after its last record."""
        self._finish_chunk()
        self._finish_loose()
        return self._builder.log()

    def _keep_index(self, offsets: MessageOffsets) -> None:
        """Keep an index of the present chunk, unless it names more messages than fit in."""
        known = sum(map(len, self._index.values()))
        if self._chunk and (known + len(offsets.offsets)) * _HEAD <= self._chunk.uncompressed_size:
            self._index[offsets.channel] = offsets.offsets.astype(np.int64)

    def _finish_chunk(self) -> None:
        """Read the chunk that was kept, now that its index is known."""
        chunk, index = self._chunk, self._index
        self._chunk, self._index = None, {}
        if chunk is not None:
            self._builder.add_messages(unpack(chunk), index, checked=chunk.uncompressed_crc != 0)

    def _keep_loose(self, record: bytes) -> None:
        self._builder.charge(len(record))
        self._loose += record
        if len(self._loose) > _LOOSE:
            self._finish_loose()

    def _finish_loose(self) -> None:
        data, self._loose = bytes(self._loose), bytearray()
        if data:
            self._builder.add_messages(data, {})
