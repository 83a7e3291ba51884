"""Reads a complete log back as columns, whole chunks at a time."""

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from google.protobuf.message import DecodeError
from mcap.exceptions import McapError
from mcap.records import Attachment, Channel, Chunk, DataEnd, McapRecord, Metadata, Schema
from numpy.typing import NDArray

from ..errors import LogError
from .log import Growing, Log, Status
from .message_starts import BOUNDARY, MESSAGE_HEAD, Starts, message_starts, windows
from .recorder import RUN_METADATA
from .records import MessageOffsets, RecordReader, unpack
from .schemas import STATUS, TF, flat_fields, message_class
from .transforms import POSE, take_transforms, transform_template
from .wire import RECORD_HEAD, Array, Records, Times, flat_dtype, take

MAX_LOG = 4 * 2**30  # bytes of messages unpacked; over an hour at 1 kHz
_HEAD = MESSAGE_HEAD + RECORD_HEAD  # bytes before the body of a message record


def read_log(path: Path, max_bytes: int = MAX_LOG) -> Log:
    """Read a complete log of ours into memory.

    Args:
        path: a log as `McapRecorder` writes it; topics and fields may have been added.
        max_bytes: bound on the unpacked messages; about half of it is kept in memory.

    Raises:
        LogError: the file cannot be read, is cut or damaged (every checksum is checked), or is not a log of ours.
    """
    with _telling(path), path.open("rb") as stream:
        content = _Content(path, max_bytes)
        for record in RecordReader(stream).records():
            content.add(record)
        return content.log()


@contextmanager
def _telling(path: Path) -> Iterator[None]:
    """Every error of reading as a LogError of one line that names the file."""
    try:
        yield
    except LogError as error:
        raise LogError(f"{path}: {error}") from error
    except OSError as error:
        raise LogError(f"{path}: cannot be read: {error.strerror}") from error
    except (McapError, DecodeError, struct.error, ValueError, KeyError, TypeError, AttributeError, OverflowError) as error:
        evidence = " ".join(str(error).split()) or type(error).__name__  # protobuf's may have several lines
        raise LogError(f"{path}: the log is damaged: {evidence}") from error


class _Content:
    """What has been found in a log so far."""

    def __init__(self, path: Path, max_bytes: int) -> None:
        self._path, self._left = path, max_bytes
        self._schemas: dict[int, Schema] = {}
        self._channels: dict[int, Channel] = {}
        self._fields: dict[int, tuple[str, ...]] = {}  # of the channels with flat messages
        self._tables: dict[int, Growing] = {}
        self._transforms: dict[int, Growing] = {}
        self._status_class: dict[int, Any] = {}
        self._statuses: list[Status] = []
        self._metadata: dict[str, dict[str, str]] = {}
        self._attachments: dict[str, bytes] = {}
        self._chunk: Chunk | None = None  # kept until its index has come
        self._index: Starts = {}

    def add(self, record: McapRecord | MessageOffsets) -> None:
        """Take in one record of the data section; the summary repeats what is known."""
        if isinstance(record, MessageOffsets):
            self._keep_index(record)
            return
        self._finish_chunk()
        if isinstance(record, Chunk):
            self._charge(record.uncompressed_size)
        elif isinstance(record, Attachment | Schema):
            self._charge(len(record.data))
        match record:
            case Schema():
                self._schemas[record.id] = record
            case Channel() if record.id not in self._channels:
                self._add_channel(record)
            case Chunk():
                self._chunk = record
            case Attachment():
                self._attachments[record.name] = record.data
            case Metadata():
                self._metadata[record.name] = record.metadata
            case DataEnd() if RUN_METADATA not in self._metadata:
                raise LogError(f"this is no log of atlas_cueing: it has no metadata record {RUN_METADATA!r}")

    def log(self) -> Log:
        """All of it, when there are no more records."""
        self._finish_chunk()
        poses = [growing.table() for growing in self._transforms.values()]
        tables = {self._channels[channel].topic: growing.table() for channel, growing in self._tables.items()}
        metadata = self._metadata.get(RUN_METADATA, {})
        return Log(self._path, tables, metadata, self._attachments, tuple(self._statuses), poses[0] if poses else None)

    def _charge(self, size: int) -> None:
        """Bound what is kept in memory; schemas and files count as messages do."""
        self._left -= size
        if self._left < 0:
            raise LogError("the content of the log is larger than allowed")

    def _add_channel(self, channel: Channel) -> None:
        self._channels[channel.id] = channel
        schema = self._schemas.get(channel.schema_id)
        if schema is None or schema.encoding != "protobuf":
            return
        if channel.topic == STATUS:
            self._status_class[channel.id] = message_class(schema.name, schema.data)
        elif channel.topic == TF:
            self._transforms[channel.id] = Growing(POSE)
        elif (fields := flat_fields(schema.name, schema.data)) is not None:
            self._tables[channel.id] = Growing(fields)
            self._fields[channel.id] = fields

    def _keep_index(self, offsets: MessageOffsets) -> None:
        """Keep what the log says of the present chunk, unless it names more messages than fit in."""
        known = sum(map(len, self._index.values()))
        if self._chunk and (known + len(offsets.offsets)) * _HEAD <= self._chunk.uncompressed_size:
            self._index[offsets.channel] = offsets.offsets.astype(np.int64)

    def _finish_chunk(self) -> None:
        """Read the chunk that was kept, now that whatever index it has is known."""
        chunk, index = self._chunk, self._index
        self._chunk, self._index = None, {}
        if chunk is not None:
            self._add_chunk(chunk, index)

    def _add_chunk(self, chunk: Chunk, index: Starts) -> None:
        """Messages of a chunk: flat ones by numpy, changes of state one by one, others skipped."""
        data = unpack(chunk)
        for channel, starts in message_starts(data, index).items():
            if channel in self._fields:
                self._tables[channel].add(*self._flat(channel, data, starts))
            if channel in self._transforms:
                self._transforms[channel].add(*self._poses(data, starts))
            for start in starts.tolist() if channel in self._status_class else ():
                end = start + RECORD_HEAD + BOUNDARY.unpack_from(data, start)[1]
                message = self._status_class[channel].FromString(data[start + _HEAD : end])
                self._statuses.append(_status(message))

    def _flat(self, channel: int, data: bytes, starts: NDArray[np.int64]) -> tuple[Array, Times]:
        """Values (n, fields) and log times of the messages of a channel at `starts`, after a look at every tag and length."""
        fields = self._fields[channel]
        records = _records(data, starts, flat_dtype(len(fields)))
        if records is not None:
            values = take(records, len(fields))
            if values is not None and np.all(records["length"] == records.itemsize - RECORD_HEAD):
                return values, records["log_time"].copy()
        raise LogError(f"a message of {self._channels[channel].topic} is not {len(fields)} doubles")

    def _poses(self, data: bytes, starts: NDArray[np.int64]) -> tuple[Array, Times]:
        records = _records(data, starts, transform_template(0).dtype)
        poses = take_transforms(records) if records is not None else None
        if records is None or poses is None:
            raise LogError(f"a message of {TF} is not base -> stage -> cabin as this program writes it")
        return poses, records["log_time"].copy()


def _status(message: Any) -> Status:
    """The log brings its own description of the message, which may call anything a time."""
    time, state, reason = message.time_s, message.state, message.reason
    if not (isinstance(time, float) and isinstance(state, str) and isinstance(reason, str)):
        raise LogError(f"a message of {STATUS} is not a time, a state and a reason")
    return Status(time, state, reason)


def _records(data: bytes, starts: NDArray[np.int64], dtype: np.dtype[np.void]) -> Records | None:
    """The records of one layout at `starts`; None when the last one does not fit into the data."""
    if starts[-1] + dtype.itemsize > len(data):
        return None
    return windows(data, dtype)[starts].view(dtype)
