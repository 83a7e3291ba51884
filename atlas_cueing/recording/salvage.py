"""Recovers what is whole in a cut or damaged log, and writes a new log of it."""

import mmap
import struct
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import BinaryIO

import numpy as np
from mcap.records import Channel, Chunk

from ..atomic_file import Destination
from ..errors import LogError
from ..signals import TOPICS
from .builder import LogBuilder
from .chunk import EncodedChunk
from .compression import unpack
from .container import LIBRARY, Container
from .log import Log
from .log_writer import write_log
from .record_walk import check_data, walk
from .recorder import RUN_METADATA
from .salvaged import BROKEN, Salvage, TooLargeError, stream
from .wire import MESSAGE_OPCODE, RECORD_HEAD

# bytes that are no record, in which chunks are looked for; 10 GB of them would take a minute
MAX_SEARCHED = 256 * 2**20
_ANY = 1 << 62  # bytes
_message = struct.Struct("<BQHIQ")  # opcode, length, channel, sequence, log time


def salvage(path: str | Path, max_bytes: int) -> Salvage:
    """Find everything whole in `path`, whose chunks may unpack to `max_bytes` together.

    Raises LogError when it cannot be read or holds no complete chunk of this program.
    """
    path = Path(path)
    found = Salvage(path, max_bytes)
    try:
        with path.open("rb") as file:
            if file.seek(0, 2):
                with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
                    walk(data, found, MAX_SEARCHED)
                    check_data(data, found)
    except OSError as error:
        raise LogError(f"{path}: cannot be read: {error.strerror}") from error
    except TooLargeError as error:
        raise LogError(f"{path}: {error}") from error
    if not found.chunks and not found.loose:
        why = f" ({found.objections[0]})" if found.objections else ""
        raise LogError(
            f"{path}: there is nothing to recover: no complete chunk of a log of atlas_cueing{why}"
        )
    found.complete = found.complete and found.finished
    return found


def contents(found: Salvage) -> Log:
    """Read everything that was found into memory; count pieces that cannot be read in `found`.

    Raises LogError when the description of a channel of this program is lost, or nothing of this
    program was found.
    """
    undescribed = sorted(found.used - found.channels.keys())
    described = {channel.topic for channel in found.channels.values()}
    if undescribed and not all(topic.name in described for topic in TOPICS):
        raise LogError(
            f"{found.path}: the description of channel {undescribed[0]} is lost, so its messages"
            " cannot be read"
        )
    loose = set(found.loose)
    try:
        builder = _builder(found)
        with found.path.open("rb") as source:
            for start, end in sorted(found.chunks + found.loose):
                source.seek(start)
                _add_piece(builder, source.read(end - start), found, loose=(start, end) in loose)
        return builder.log()
    except BROKEN as error:
        raise LogError(f"{found.path}: {error}") from error


def rewrite(
    found: Salvage, output: Path, metadata: Mapping[str, str], log: Log | None = None
) -> None:
    """Write a finished log of all that was found, under a temporary name until it is complete.

    Chunks of this program are copied, with all channels; what lies in any other way is written anew
    as this program does, without the channels that it cannot read.

    Args:
        found: what was found in the broken log.
        output: path of the new log.
        metadata: the record `atlas.run` of the new log.
        log: the contents of `found`, if they have been read.

    Raises LogError as `contents` does, and OSError when the log cannot be written.
    """
    log = log or contents(found)
    destination = Destination(output)
    part = destination.passing()  # the .part may be the very log that is recovered
    try:
        with part.open("xb") as target, found.path.open("rb") as source:
            container = Container(target.write)
            if copied(found):
                _copy(found, source, container, metadata)
            else:
                write_log(container, log, metadata)
        destination.take(part)
    except OSError:
        part.unlink(missing_ok=True)  # half of it is of no use: the broken log is still there
        raise


def copied(found: Salvage) -> bool:
    """Return whether the chunks are copied as they are.

    They are if all of the log lies as this program writes it, and can be read.
    """
    topics = [channel.topic for channel in found.channels.values()]
    return (
        found.ours
        and sorted(found.channels) == list(range(1, len(topics) + 1))
        and len(set(topics)) == len(topics)
        and all(_is_protobuf(found, channel) for channel in found.channels.values())
    )


def _copy(
    found: Salvage, source: BinaryIO, container: Container, metadata: Mapping[str, str]
) -> None:
    for _, channel in sorted(found.channels.items()):
        schema = found.schemas[channel.schema_id]
        container.add_channel(channel.topic, schema.name, schema.data)
    for name, content in found.attachments.items():
        container.add_attachment(name, "application/toml", content)
    for start, end in found.chunks:
        source.seek(start)
        chunk = _encoded(unpack(Chunk.read(stream(source.read(end - start)))))
        if chunk.index:  # whole, but without any message
            container.add_chunk(chunk)
    container.add_metadata(RUN_METADATA, metadata)
    container.finish()


def _encoded(data: bytes) -> EncodedChunk:
    """Return the chunk with a new index of its messages."""
    index: dict[int, list[tuple[int, int]]] = {}
    for start, channel, log_time in _messages(data):
        index.setdefault(channel, []).append((log_time, start))
    return EncodedChunk(
        data,
        {channel: np.array(entries, dtype=np.uint64) for channel, entries in sorted(index.items())},
    )


def _is_protobuf(found: Salvage, channel: Channel) -> bool:
    schema = found.schemas.get(channel.schema_id)
    return schema is not None and (channel.message_encoding, schema.encoding) == (
        "protobuf",
        "protobuf",
    )


def _builder(found: Salvage) -> LogBuilder:
    """Return a builder with all descriptions and files that were found."""
    builder = LogBuilder(found.path, _ANY)  # what chunks unpack to has been counted
    for schema in found.schemas.values():
        builder.add_schema(schema)
    for channel in found.channels.values():
        builder.add_channel(channel)
    for number in found.used - found.channels.keys():
        topic = f"channel {number}, whose description is lost"
        builder.add_channel(
            Channel(id=number, topic=topic, message_encoding="", metadata={}, schema_id=0)
        )
    for name, content in found.attachments.items():
        builder.add_attachment(name, content)
    if found.metadata:
        builder.add_metadata(RUN_METADATA, found.metadata)
    builder.library = LIBRARY if found.ours else ""
    return builder


def _add_piece(builder: LogBuilder, data: bytes, found: Salvage, *, loose: bool) -> None:
    """Read the messages of a chunk or stretch.

    Those of a stretch are read one by one when they cannot be read at once.
    """
    content = data if loose else unpack(Chunk.read(stream(data)))
    starts = [start for start, _, _ in _messages(content)] if loose else []
    try:
        # recover itself reports messages without a checksum, so none is noted here
        builder.add_messages(content, {}, checked=True, all_or_none=True)
    except BROKEN as error:
        if len(starts) > 1:
            for start, end in pairwise([*starts, len(content)]):
                _add_piece(builder, content[start:end], found, loose=True)
        else:
            found.object(error)
            found.ours = False  # or the new log could not be read either


def _messages(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Yield offset, channel and log time (ns) of each message of a chunk."""
    position = 0
    while position + _message.size <= len(data):
        opcode, length, channel, _, log_time = _message.unpack_from(data, position)
        if opcode == MESSAGE_OPCODE:
            yield position, channel, log_time
        position += RECORD_HEAD + length
