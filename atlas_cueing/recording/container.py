"""Writes the MCAP container: header, schemas, channels, attachments, indexed chunks, summary.

Record layouts are mcap's own (https://mcap.dev/spec). Schemas, channels and attachments come first,
so that what is left of a broken log can be read.
"""

import struct
import zlib
from collections.abc import Callable, Iterable, Mapping

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    Chunk,
    ChunkIndex,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

from .chunk import EncodedChunk
from .wire import EPOCH_NS

MAGIC = b"\x89MCAP0\r\n"
LIBRARY = "atlas_cueing"
# doubles hardly compress: files of 1.08 times the size of level 1's, in 0.3 times the time
ZSTD_LEVEL = -8


class Container:
    """Writes an MCAP file from its first byte to its last."""

    def __init__(self, write: Callable[[bytes], object]) -> None:
        """Write magic and header; `write` keeps all bytes it is given or raises."""
        self._write = write
        self._position = 0
        self._crc = 0
        self._compressor = zstandard.ZstdCompressor(level=ZSTD_LEVEL)
        self._schemas: list[Schema] = []
        self._channels: list[Channel] = []
        self._attachments: list[AttachmentIndex] = []
        self._metadata: list[MetadataIndex] = []
        self._chunk_indexes: list[bytes] = []  # as bytes: a live log has ten a second
        self._span: tuple[int, int] | None = None
        self._counts: dict[int, int] = {}
        self._put(MAGIC)
        self._record(Header(profile="", library=LIBRARY))

    def add_channel(self, topic: str, name: str, schema: bytes) -> int:
        """Add a channel of protobuf messages `name`; return its id.

        `schema` is a serialised FileDescriptorSet.
        """
        number = len(self._channels) + 1
        self._schemas.append(Schema(id=number, data=schema, encoding="protobuf", name=name))
        self._channels.append(
            Channel(
                id=number, topic=topic, message_encoding="protobuf", metadata={}, schema_id=number
            )
        )
        self._record(self._schemas[-1])
        self._record(self._channels[-1])
        return number

    def add_attachment(self, name: str, media_type: str, data: bytes) -> None:
        """Write a file into the log."""
        record = Attachment(
            create_time=EPOCH_NS, log_time=EPOCH_NS, name=name, media_type=media_type, data=data
        )
        offset, length = self._record(record)
        self._attachments.append(
            AttachmentIndex(offset, length, EPOCH_NS, EPOCH_NS, len(data), name, media_type)
        )

    def add_metadata(self, name: str, pairs: Mapping[str, str]) -> None:
        """Write a map from string to string into the log."""
        offset, length = self._record(Metadata(name=name, metadata=dict(pairs)))
        self._metadata.append(MetadataIndex(offset, length, name))

    def add_chunk(self, chunk: EncodedChunk) -> None:
        """Write a chunk and the index of its messages, in one go."""
        times = [index[:, 0] for index in chunk.index.values()]
        first, last = min(int(t.min()) for t in times), max(int(t.max()) for t in times)
        packed = self._compressor.compress(chunk.data)
        size = len(chunk.data)
        parts = [_serialise(Chunk("zstd", packed, last, first, zlib.crc32(chunk.data), size))]
        length, offsets = len(parts[0]), {}
        end = self._position + length
        for channel, index in chunk.index.items():
            offsets[channel] = end
            parts.append(_message_index(channel, index.astype("<u8").tobytes()))
            end += len(parts[-1])
            self._counts[channel] = self._counts.get(channel, 0) + len(index)
        self._span = (
            (min(first, self._span[0]), max(last, self._span[1])) if self._span else (first, last)
        )
        self._chunk_indexes.append(
            _serialise(
                ChunkIndex(
                    chunk_length=length,
                    chunk_start_offset=self._position,
                    compression="zstd",
                    compressed_size=len(packed),
                    message_end_time=last,
                    message_index_length=end - self._position - length,
                    message_index_offsets=offsets,
                    message_start_time=first,
                    uncompressed_size=size,
                )
            )
        )
        self._put(b"".join(parts))

    def finish(self) -> None:
        """Write the end of the data, the summary with its checksums, and the footer."""
        self._record(DataEnd(self._crc))
        start = self._position
        self._crc = 0
        offsets = [self._group(op, records) for op, records in self._summary() if records]
        offset_start = self._position
        for offset in offsets:
            self._record(offset)
        # the summary's checksum covers the footer up to the checksum itself
        unchecked = _serialise(Footer(start, offset_start, 0))[:-4]
        self._record(Footer(start, offset_start, zlib.crc32(unchecked, self._crc)))
        self._put(MAGIC)

    def _summary(self) -> Iterable[tuple[Opcode, list[bytes]]]:
        """Yield the groups of the summary, in order."""
        yield Opcode.SCHEMA, [_serialise(schema) for schema in self._schemas]
        yield Opcode.CHANNEL, [_serialise(channel) for channel in self._channels]
        yield Opcode.STATISTICS, [_serialise(self._statistics())]
        yield Opcode.CHUNK_INDEX, self._chunk_indexes
        yield Opcode.ATTACHMENT_INDEX, [_serialise(attachment) for attachment in self._attachments]
        yield Opcode.METADATA_INDEX, [_serialise(metadata) for metadata in self._metadata]

    def _statistics(self) -> Statistics:
        first, last = self._span or (0, 0)
        return Statistics(
            attachment_count=len(self._attachments),
            channel_count=len(self._channels),
            channel_message_counts=dict(sorted(self._counts.items())),
            chunk_count=len(self._chunk_indexes),
            message_count=sum(self._counts.values()),
            message_end_time=last,
            message_start_time=first,
            metadata_count=len(self._metadata),
            schema_count=len(self._schemas),
        )

    def _group(self, opcode: Opcode, records: list[bytes]) -> SummaryOffset:
        start = self._position
        for record in records:
            self._put(record)
        return SummaryOffset(opcode, start, self._position - start)

    def _record(self, record: McapRecord) -> tuple[int, int]:
        """Write one record; return its offset and length."""
        data = _serialise(record)
        offset = self._position
        self._put(data)
        return offset, len(data)

    def _put(self, data: bytes) -> None:
        self._write(data)
        self._position += len(data)
        self._crc = zlib.crc32(data, self._crc)


def _serialise(record: McapRecord) -> bytes:
    builder = RecordBuilder()
    record.write(builder)
    # mcap gives types to all but this one
    return bytes(builder.end())  # type: ignore[no-untyped-call]


def _message_index(channel: int, entries: bytes) -> bytes:
    """Serialise a MessageIndex with entries (log time, offset) that are bytes already."""
    return (
        struct.pack("<BQHI", Opcode.MESSAGE_INDEX, 6 + len(entries), channel, len(entries))
        + entries
    )
