"""Reads the records of an MCAP file one after the other, with every checksum checked.

mcap's own reader takes a message at a time and unpacks any size that a chunk claims; here a chunk
stays whole and bounded.
"""

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from struct import Struct
from typing import BinaryIO

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    Channel,
    Chunk,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Metadata,
    Schema,
    Statistics,
)
from numpy.typing import NDArray

from ..errors import LogError
from .compression import check_crc
from .container import MAGIC

MAX_RECORD = 64 * 2**20  # bytes; the recorder's are below 1 MB, an attachment may be larger
_head = Struct("<BQ")
_index_head = Struct("<HI")  # channel, bytes of the entries that follow
_ENTRY = np.dtype([("log_time", "<u8"), ("offset", "<u8")])
_READ = {
    Opcode.ATTACHMENT: Attachment.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.CHUNK: Chunk.read,
    Opcode.DATA_END: DataEnd.read,
    Opcode.FOOTER: Footer.read,
    Opcode.HEADER: Header.read,
    Opcode.METADATA: Metadata.read,
    Opcode.SCHEMA: Schema.read,
    Opcode.STATISTICS: Statistics.read,
}


@dataclass(frozen=True, slots=True)
class MessageOffsets:
    """Where the messages of a channel start in the chunk before, by the log's own index."""

    channel: int
    offsets: NDArray[np.uint64]


@dataclass(frozen=True, slots=True)
class LooseMessage:
    """A whole message record that lies outside of chunks."""

    record: bytes


@dataclass(slots=True)
class RecordReader:
    """Reads the records of `stream`, up to the Footer."""

    stream: BinaryIO
    _crc: int = field(default=0, init=False)
    _position: int = field(default=0, init=False)
    _data_end: int = field(default=0, init=False)

    def records(self) -> Iterator[McapRecord | MessageOffsets | LooseMessage]:
        """Yield all records but the summary's indexes; the data section ends with a DataEnd.

        A checksum of 0 means that there is none, by the format.

        Raises LogError where the file is cut, a checksum is wrong, or the summary is not where the
        footer has it.
        """
        if self._take(len(MAGIC)) != MAGIC:
            raise LogError("this is no MCAP file")
        while True:
            before = self._crc
            head = self._take(_head.size)
            opcode, length = _head.unpack(head)
            if opcode == 0:  # which MCAP forbids; a hole of 10 GB is a billion of them
                raise LogError("a record has no kind")
            if length > MAX_RECORD:
                raise LogError(f"a record claims {length} bytes, allowed: at most {MAX_RECORD}")
            body = self._take(length)
            if opcode == Opcode.ATTACHMENT:  # mcap does not look at it
                check_crc("attachment", int.from_bytes(body[-4:], "little"), zlib.crc32(body[:-4]))
            if opcode == Opcode.MESSAGE_INDEX:
                yield _offsets(body)
            elif opcode == Opcode.MESSAGE:
                yield LooseMessage(head + body)
            elif opcode in _READ:
                record = _READ[opcode](ReadDataStream(BytesIO(body)))
                yield record
                if isinstance(record, DataEnd):
                    check_crc("data section", record.data_section_crc, before)
                    self._crc, self._data_end = 0, self._position
                if isinstance(record, Footer):
                    check_crc(
                        "summary",
                        record.summary_crc,
                        zlib.crc32(body[:-4], zlib.crc32(head, before)),
                    )
                    self._check_summary(record.summary_start)
                    break
        if self.stream.read(len(MAGIC) + 1) != MAGIC:
            raise LogError("the file does not end after its footer")

    def _check_summary(self, start: int) -> None:
        """Check that the summary follows the data; a start of 0 means that there is none."""
        if start not in (0, self._data_end):
            raise LogError(f"the footer has the summary at byte {start}; it is at {self._data_end}")

    def _take(self, size: int) -> bytes:
        data = self.stream.read(size)
        if len(data) < size:
            raise LogError("the file is cut" if self._position or data else "the file is empty")
        self._crc = zlib.crc32(data, self._crc)
        self._position += size
        return data


def _offsets(body: bytes) -> MessageOffsets:
    """Read a MessageIndex record at once; mcap's own class takes an entry at a time."""
    channel, size = _index_head.unpack_from(body)
    if size != len(body) - _index_head.size:
        raise LogError("an index claims another size than it has")
    return MessageOffsets(channel, np.frombuffer(body, _ENTRY, offset=_index_head.size)["offset"])
