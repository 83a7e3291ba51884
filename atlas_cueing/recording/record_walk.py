"""Walks from record to record through a cut or damaged file.

Records follow one another by their lengths. Where that chain breaks, the next chunk is found by the
words that every chunk holds, and its checksum shows whether it is one.
"""

import mmap
import re
import struct
import zlib

from mcap.opcode import Opcode

from .compression import check_crc
from .container import MAGIC
from .records import MAX_RECORD
from .salvaged import BROKEN, READ, STRETCH, Salvage, TooLargeError, stream
from .wire import RECORD_HEAD

# a chunk below 2^32 bytes: opcode, length, 28 bytes, and the length and word of a compression
_CHUNK = re.compile(rb"\x06.{4}\0{4}.{28}(?:\x04\0{3}zstd|\x03\0{3}lz4|\0{4})", re.DOTALL)
_MESSAGE = re.compile(rb"\x05.{4}\0{4}", re.DOTALL)
_LONGEST = 64  # bytes that the patterns look at, and more
_head = struct.Struct("<BQ")
_message = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log time, publish time
_INDEXES = {
    Opcode.MESSAGE_INDEX,
    Opcode.CHUNK_INDEX,
    Opcode.ATTACHMENT_INDEX,
    Opcode.METADATA_INDEX,
}
_KNOWN = {*READ, *_INDEXES, Opcode.HEADER, Opcode.MESSAGE, Opcode.STATISTICS, Opcode.SUMMARY_OFFSET}


def walk(data: mmap.mmap, found: Salvage, max_searched: int) -> None:
    """Take every whole record of the file; where their chain breaks, look for the next chunk.

    Args:
        data: the file.
        found: takes the records.
        max_searched: bytes in which chunks are looked for, altogether.
    """
    position, searched = len(MAGIC), 0
    while position < len(data) - len(MAGIC):
        end = _take(data, position, found)
        if end is None:
            found.complete = False
            end = _next_start(data, position + 1, position + max_searched - searched, found)
            searched += end - position
        position = end


def _take(data: mmap.mmap, start: int, found: Salvage) -> int | None:
    """Take the record at `start`; return where it ends, or None when there is no record."""
    if start + RECORD_HEAD > len(data):
        return None
    opcode, length = _head.unpack_from(data, start)
    end: int = start + RECORD_HEAD + length
    if opcode not in _KNOWN or length > MAX_RECORD or end > len(data):
        return None
    if opcode == Opcode.MESSAGE:
        return _take_message(data, start, end, found)
    try:
        if opcode in READ:
            body = data[start + RECORD_HEAD : end]
            if opcode == Opcode.ATTACHMENT:  # mcap does not look at it
                check_crc("attachment", int.from_bytes(body[-4:], "little"), zlib.crc32(body[:-4]))
            found.take(READ[opcode](stream(body)), start + RECORD_HEAD, end)
    except TooLargeError:
        raise
    except BROKEN as error:
        if opcode == Opcode.CHUNK:
            found.object(error)
        found.complete = False
        return end if _follows(data, end) else None
    return end


def _take_message(data: mmap.mmap, start: int, end: int, found: Salvage) -> int | None:
    """Take the message record outside of chunks at `start`; return as `_take` does."""
    if end < start + _message.size or not (end == len(data) - len(MAGIC) or _follows(data, end)):
        return None
    found.take_message(_message.unpack_from(data, start)[2], start, end)
    return end


def check_data(data: mmap.mmap, found: Salvage) -> None:
    """Compare the checksum of the data section, if messages have none of their own."""
    end, expected = found.data_end
    if not (found.unchecked and expected):
        return
    crc = 0
    for start in range(0, end, STRETCH):
        crc = zlib.crc32(data[start : min(start + STRETCH, end)], crc)
    if crc != expected:
        found.doubtful, found.complete = True, False


def _follows(data: mmap.mmap, position: int) -> bool:
    """Return whether a record seems to start at `position`."""
    return bool(position + RECORD_HEAD <= len(data) and data[position] in _KNOWN)


def _next_start(data: mmap.mmap, position: int, last: int, found: Salvage) -> int:
    """Return the start of the next thing that looks like a chunk, up to `last`.

    Where all messages up to here lie outside of chunks, it is that of the next message that another
    record follows. It is the end of the file when there is none.
    """
    messages = bool(found.loose) and not found.chunks
    pattern, follows = (_MESSAGE, _is_message) if messages else (_CHUNK, _is_chunk)
    while (
        match := pattern.search(data, position, min(last + _LONGEST, len(data)))
    ) and match.start() <= last:
        position = match.start() + 1
        if follows(data, match.start(), found):
            return match.start()
    return len(data)


def _is_chunk(data: mmap.mmap, start: int, _: Salvage) -> bool:
    """Return whether the lengths in what looks like a chunk fit each other."""
    length = _head.unpack_from(data, start)[1]
    content = start + RECORD_HEAD
    word = int.from_bytes(data[content + 28 : content + 32], "little")
    packed = int.from_bytes(data[content + 32 + word : content + 40 + word], "little")
    return bool(length == 40 + word + packed and content + length <= len(data))


def _is_message(data: mmap.mmap, start: int, found: Salvage) -> bool:
    """Return whether what looks like a message is of a known channel and a record follows it."""
    if start + _message.size > len(data):
        return False
    _, length, channel, *_ = _message.unpack_from(data, start)
    return (
        channel in found.channels
        and length <= MAX_RECORD
        and _follows(data, start + RECORD_HEAD + int(length))
    )
