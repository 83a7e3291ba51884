"""The content of a cut or damaged log that has been found whole."""

import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any

from google.protobuf.message import DecodeError
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, DataEnd, Footer, McapRecord, Metadata, Schema

from ..errors import LogError
from .compression import unpack
from .message_starts import message_starts
from .recorder import RUN_METADATA
from .wire import RECORD_HEAD

STRETCH = 2**20  # bytes of messages outside of chunks that are read at a time
READ: dict[int, Callable[[ReadDataStream], McapRecord]] = {
    Opcode.ATTACHMENT: Attachment.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.CHUNK: Chunk.read,
    Opcode.DATA_END: DataEnd.read,
    Opcode.FOOTER: Footer.read,
    Opcode.METADATA: Metadata.read,
    Opcode.SCHEMA: Schema.read,
}
# the errors of reading a damaged record or message
BROKEN = (
    LogError,
    DecodeError,
    McapError,
    struct.error,
    ValueError,
    KeyError,
    TypeError,
    OverflowError,
    EOFError,
)


class TooLargeError(LogError):
    """A file whose chunks together unpack to more than they may."""


@dataclass(slots=True)
class Salvage:
    """What is whole in a log.

    complete: nothing was found amiss.
    chunks: their places in the file, in order.
    loose: places of stretches of messages outside of chunks, in order.
    damaged: number of pieces that cannot be read; `objections` are the reasons.
    doubtful: messages without a checksum of their own lie in a data section whose checksum is
        wrong.
    ours: everything lies as this program writes it, so that chunks can be copied.
    """

    path: Path
    bytes_left: int  # that chunks may still unpack to
    complete: bool = True
    chunks: list[tuple[int, int]] = field(default_factory=list)
    loose: list[tuple[int, int]] = field(default_factory=list)
    damaged: int = 0
    objections: list[Exception] = field(default_factory=list)
    doubtful: bool = False
    ours: bool = True
    metadata: dict[str, str] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    used: set[int] = field(default_factory=set)  # channels that have messages
    unchecked: bool = False  # there are messages without a checksum of their own
    data_end: tuple[int, int] = (0, 0)  # where the data section ends, and its checksum
    finished: bool = False

    def take(self, record: McapRecord, start: int, end: int) -> None:
        """Keep one record that lies at start to end in the file.

        A chunk is unpacked to see that it is whole.
        """
        match record:
            case Schema():
                self.schemas.setdefault(record.id, record)
            case Channel():
                self.channels.setdefault(record.id, record)
            case Attachment():
                self.attachments.setdefault(record.name, record.data)
            case Metadata() if record.name == RUN_METADATA:
                self.metadata = record.metadata
            case DataEnd():
                self.data_end = (start - RECORD_HEAD, record.data_section_crc)
            case Footer():
                self.finished = True
            case Chunk():
                self._charge(record.uncompressed_size)
                self.used |= message_starts(unpack(record), {}, self._describe).keys()
                self.chunks.append((start, end))
                self.ours = self.ours and record.compression == "zstd"
                self.unchecked = self.unchecked or not record.uncompressed_crc

    def take_message(self, channel: int, start: int, end: int) -> None:
        """Keep a message record outside of chunks."""
        self._charge(end - start)
        self.ours, self.unchecked = False, True
        self.used.add(channel)
        if self.loose and self.loose[-1][1] == start and end - self.loose[-1][0] <= STRETCH:
            self.loose[-1] = (self.loose[-1][0], end)
        else:
            self.loose.append((start, end))

    def object(self, why: Exception) -> None:
        """Note that a piece cannot be read."""
        self.damaged += 1
        self.complete = False
        if str(why) not in map(str, self.objections):
            self.objections.append(why)

    def _charge(self, size: int) -> None:
        self.bytes_left -= size
        if self.bytes_left < 0:
            raise TooLargeError("its chunks unpack to more than is allowed")

    def _describe(self, opcode: int, body: bytes) -> None:
        """Keep a schema or channel from inside a chunk."""
        if opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
            self.ours = False
            self.take(READ[opcode](stream(body)), 0, 0)


def stream(data: bytes) -> Any:
    """Return the data as the stream that mcap reads records from, which has no types."""
    return ReadDataStream(BytesIO(data))
