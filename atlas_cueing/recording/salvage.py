"""Everything that is whole in a cut or damaged log, and a new log of it.

Records follow one another by their lengths. Where that chain breaks, the next chunk is found by the words every chunk of ours
holds, and its checksum says whether it is one.
"""

import mmap
import struct
import zlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Footer, McapRecord, Metadata, Schema

from ..errors import LogError
from .chunk import EncodedChunk
from .compression import unpack
from .container import MAGIC, Container
from .recorder import RUN_METADATA
from .records import MAX_RECORD
from .wire import MESSAGE_OPCODE, RECORD_HEAD

MAX_SEARCHED = 256 * 2**20  # bytes that are no record, in which chunks are looked for; 10 GB of them would take a minute
_COMPRESSION = b"\x04\x00\x00\x00zstd"  # a length and a word, 37 bytes into every chunk of ours
_INTO_CHUNK = RECORD_HEAD + 28
_head = struct.Struct("<BQ")
_message = struct.Struct("<BQHIQ")  # opcode, length, channel, sequence, log time
_MESSAGE_HEAD = _message.size
_READ: dict[int, Callable[[ReadDataStream], McapRecord]] = {
    Opcode.ATTACHMENT: Attachment.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.CHUNK: Chunk.read,
    Opcode.FOOTER: Footer.read,
    Opcode.METADATA: Metadata.read,
    Opcode.SCHEMA: Schema.read,
}
_PLAIN = {*_READ, Opcode.HEADER, Opcode.MESSAGE_INDEX, Opcode.CHUNK_INDEX, Opcode.ATTACHMENT_INDEX, Opcode.STATISTICS}
_KNOWN = {*_PLAIN, Opcode.METADATA_INDEX, Opcode.SUMMARY_OFFSET, Opcode.DATA_END}


class TooLargeError(LogError):
    """A file whose chunks together unpack to more than they may."""


@dataclass(slots=True)
class Salvage:
    """What is whole in a log: `chunks` are places in the file, in order; `complete` says that nothing was found amiss."""

    path: Path
    bytes_left: int  # that chunks may still unpack to
    complete: bool = True
    chunks: list[tuple[int, int]] = field(default_factory=list)
    damaged: int = 0
    metadata: dict[str, str] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    finished: bool = False

    def take(self, record: McapRecord, start: int, end: int) -> None:
        """Keep one record that lies at start to end in the file; a chunk is unpacked to see that it is whole."""
        match record:
            case Schema():
                self.schemas.setdefault(record.id, record)
            case Channel():
                self.channels.setdefault(record.id, record)
            case Attachment():
                self.attachments.setdefault(record.name, record.data)
            case Metadata() if record.name == RUN_METADATA:
                self.metadata = record.metadata
            case Footer():
                self.finished = True
            case Chunk():
                self.bytes_left -= record.uncompressed_size
                if self.bytes_left < 0:
                    raise TooLargeError("its chunks unpack to more than is allowed")
                unpack(record)
                self.chunks.append((start, end))


def salvage(path: Path, max_bytes: int) -> Salvage:
    """Find everything whole in `path`, whose chunks may unpack to `max_bytes` together.

    Raises LogError when it cannot be read or holds no complete chunk of ours.
    """
    found = Salvage(path, max_bytes)
    try:
        with path.open("rb") as file:
            if file.seek(0, 2):
                with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
                    _walk(data, found)
    except OSError as error:
        raise LogError(f"{path}: cannot be read: {error.strerror}") from error
    except TooLargeError as error:
        raise LogError(f"{path}: {error}") from error
    if not found.chunks:
        raise LogError(f"{path}: there is nothing to recover: no complete chunk of a log of atlas_cueing")
    found.complete = found.complete and found.finished
    return found


def rewrite(found: Salvage, output: Path, metadata: Mapping[str, str]) -> None:
    """Write a finished log of all that was found to `output`, under a passing name until it is complete.

    Raises LogError when the descriptions of the channels are lost, and OSError when it cannot be written.
    """
    part = output.with_name(output.name + ".recovering")  # the .part may be the very log that is recovered
    try:
        with part.open("wb") as target, found.path.open("rb") as source:
            _write(found, source, Container(target.write), metadata)
        part.replace(output)
    except OSError:
        part.unlink(missing_ok=True)  # half of it is of no use: the broken log is still there
        raise


def _write(found: Salvage, source: BinaryIO, container: Container, metadata: Mapping[str, str]) -> None:
    for number in range(1, max(found.channels, default=0) + 1):
        _add_channel(container, found, number)
    for name, content in found.attachments.items():
        container.add_attachment(name, "application/toml", content)
    for start, end in found.chunks:
        source.seek(start)
        chunk = _encoded(unpack(Chunk.read(_stream(source.read(end - start)))), found)
        if chunk.index:  # whole, but without any message
            container.add_chunk(chunk)
    container.add_metadata(RUN_METADATA, metadata)
    container.finish()


def _walk(data: mmap.mmap, found: Salvage) -> None:
    """Take every whole record of the file, looking for the next chunk wherever the chain of records breaks."""
    position, searched = len(MAGIC), 0
    while position < len(data) - len(MAGIC):
        end = _take(data, position, found)
        if end is None:
            found.complete = False
            end = _next_chunk(data, position + 1, position + MAX_SEARCHED - searched)
            searched += end - position
        position = end


def _take(data: mmap.mmap, start: int, found: Salvage) -> int | None:
    """Take the record at `start`; where it ends, or None when it is none."""
    if start + RECORD_HEAD > len(data):
        return None
    opcode, length = _head.unpack_from(data, start)
    end: int = start + RECORD_HEAD + length
    if opcode not in _KNOWN or length > MAX_RECORD or end > len(data):
        return None
    try:
        if opcode in _READ:
            body = data[start + RECORD_HEAD : end]
            if opcode == Opcode.ATTACHMENT and body[-4:] != zlib.crc32(body[:-4]).to_bytes(4, "little"):
                raise LogError("the checksum of an attachment is wrong")  # mcap does not look at it
            found.take(_READ[opcode](_stream(body)), start + RECORD_HEAD, end)
    except TooLargeError:
        raise
    except (LogError, McapError, struct.error, ValueError, KeyError, TypeError, OverflowError, EOFError):
        found.damaged += opcode == Opcode.CHUNK
        found.complete = False
        return end if _follows(data, end) else None
    return end


def _follows(data: mmap.mmap, position: int) -> bool:
    """Whether a record seems to start there."""
    return position + RECORD_HEAD <= len(data) and data[position] in _KNOWN


def _next_chunk(data: mmap.mmap, position: int, last: int) -> int:
    """Start of the next thing that looks like a chunk, up to `last`; the end of the file when there is none."""
    while (place := data.find(_COMPRESSION, position + _INTO_CHUNK, max(last, position) + _INTO_CHUNK)) >= 0:
        start = place - _INTO_CHUNK
        if data[start] == Opcode.CHUNK:
            return start
        position = start + 1
    return len(data)


def _add_channel(container: Container, found: Salvage, number: int) -> None:
    channel = found.channels.get(number)
    schema = found.schemas.get(channel.schema_id) if channel else None
    if channel is None or schema is None:
        raise LogError(f"{found.path}: the description of channel {number} is lost, so its messages cannot be read")
    container.add_channel(channel.topic, schema.name, schema.data)


def _encoded(data: bytes, found: Salvage) -> EncodedChunk:
    """The chunk with the index of its messages made again."""
    index: dict[int, list[tuple[int, int]]] = {}
    for start, channel, log_time in _messages(data):
        if channel not in found.channels:
            raise LogError(f"{found.path}: the description of channel {channel} is lost, so its messages cannot be read")
        index.setdefault(channel, []).append((log_time, start))
    return EncodedChunk(data, {channel: np.array(entries, dtype=np.uint64) for channel, entries in sorted(index.items())})


def _messages(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Place, channel and log time (ns) of each message of a chunk."""
    position = 0
    while position + _MESSAGE_HEAD <= len(data):
        opcode, length, channel, _, log_time = _message.unpack_from(data, position)
        if opcode == MESSAGE_OPCODE:
            yield position, channel, log_time
        position += RECORD_HEAD + length


def _stream(data: bytes) -> Any:
    """As mcap reads records from; it has no types."""
    return ReadDataStream(BytesIO(data))
