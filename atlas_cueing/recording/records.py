"""Records of an MCAP file one after the other, with every checksum checked.

mcap's own reader takes a message at a time and unpacks whatever size a chunk claims; here a chunk stays whole and bounded.
"""

import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from struct import Struct
from typing import BinaryIO

import numpy as np
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, DataEnd, Footer, McapRecord, Metadata, Schema
from numpy.typing import NDArray

from ..errors import LogError
from .container import MAGIC

MAX_RECORD = 64 * 2**20  # bytes; ours are below 1 MB, an attachment may be larger
MAX_CHUNK = 64 * 2**20  # bytes unpacked; 33 kB can unpack to 1 GiB
_head = Struct("<BQ")
_index_head = Struct("<HI")  # channel, bytes of the entries that follow
_ENTRY = np.dtype([("log_time", "<u8"), ("offset", "<u8")])
_READ = {
    Opcode.ATTACHMENT: Attachment.read,
    Opcode.CHANNEL: Channel.read,
    Opcode.CHUNK: Chunk.read,
    Opcode.DATA_END: DataEnd.read,
    Opcode.FOOTER: Footer.read,
    Opcode.METADATA: Metadata.read,
    Opcode.SCHEMA: Schema.read,
}


@dataclass(frozen=True, slots=True)
class MessageOffsets:
    """What a log says about the chunk before: where the messages of a channel start in it."""

    channel: int
    offsets: NDArray[np.uint64]


@dataclass(slots=True)
class RecordReader:
    """Reads the records of `stream`; the data section ends with a DataEnd, the file with a Footer."""

    stream: BinaryIO
    _crc: int = field(default=0, init=False)

    def records(self) -> Iterator[McapRecord | MessageOffsets]:
        """All records but the summary's indexes and statistics. Raises LogError where the file is cut or a checksum wrong."""
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
                _check("attachment", int.from_bytes(body[-4:], "little"), zlib.crc32(body[:-4]))
            if opcode == Opcode.MESSAGE_INDEX:
                yield _offsets(body)
            elif opcode in _READ:
                record = _READ[opcode](ReadDataStream(BytesIO(body)))
                yield record
                if isinstance(record, DataEnd):
                    _check("data section", record.data_section_crc, before)
                    self._crc = 0
                if isinstance(record, Footer):
                    _check("summary", record.summary_crc, zlib.crc32(body[:-4], zlib.crc32(head, before)))
                    break
        if self.stream.read(len(MAGIC) + 1) != MAGIC:
            raise LogError("the file does not end after its footer")

    def _take(self, size: int) -> bytes:
        data = self.stream.read(size)
        if len(data) < size:
            raise LogError("the file is cut")
        self._crc = zlib.crc32(data, self._crc)
        return data


def _offsets(body: bytes) -> MessageOffsets:
    """A MessageIndex record, whole; mcap's own class takes an entry at a time."""
    channel, size = _index_head.unpack_from(body)
    if size != len(body) - _index_head.size:
        raise LogError("an index claims another size than it has")
    return MessageOffsets(channel, np.frombuffer(body, _ENTRY, offset=_index_head.size)["offset"])


def unpack(chunk: Chunk) -> bytes:
    """The messages of a chunk. Raises LogError if they are damaged, too large or packed in another way than ours."""
    if chunk.compression != "zstd":
        raise LogError(f"a chunk has compression {chunk.compression!r}, allowed: 'zstd'")
    if chunk.uncompressed_size > MAX_CHUNK:
        raise LogError(f"a chunk unpacks to {chunk.uncompressed_size} bytes, allowed: at most {MAX_CHUNK}")
    try:
        claimed = zstandard.frame_content_size(chunk.data)
        # the decompressor believes the size in the frame, whatever it is told
        data = zstandard.ZstdDecompressor().decompress(chunk.data) if claimed == chunk.uncompressed_size else b""
    except zstandard.ZstdError as error:
        raise LogError(f"a chunk cannot be unpacked: {error}") from error
    if len(data) != chunk.uncompressed_size:
        raise LogError(f"a chunk unpacks to another size than the {chunk.uncompressed_size} bytes it claims")
    _check("chunk", chunk.uncompressed_crc, zlib.crc32(data))
    return data


def _check(what: str, expected: int, found: int) -> None:
    if expected != found:
        raise LogError(f"the checksum of the {what} is wrong ({found:#010x} instead of {expected:#010x})")
