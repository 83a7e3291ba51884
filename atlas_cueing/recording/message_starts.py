"""Finds where the messages of a chunk start."""

from collections.abc import Callable
from struct import Struct
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..errors import LogError
from .wire import MESSAGE_OPCODE, RECORD_HEAD

Starts: TypeAlias = dict[int, NDArray[np.int64]]

MESSAGE_HEAD = 22  # bytes: channel, sequence, log time, publish time
BOUNDARY = Struct("<BQH")  # opcode, length, channel
_DTYPE = np.dtype([("opcode", "u1"), ("length", "<u8"), ("channel", "<u2")])


def message_starts(
    data: bytes, index: Starts, others: Callable[[int, bytes], None] | None = None
) -> Starts:
    """Return the offset of every message in a chunk, by channel.

    Args:
        data: the records of the chunk.
        index: the offsets by the log itself. They are used only if the records they name fill the
            chunk without a gap; otherwise, also for chunks of other writers with records that are
            no messages, one record is found after the other, which takes 20 times as long.
        others: called with opcode and body of each record that is no message, in order; most
            writers put the descriptions of channels into chunks.

    Raises LogError where a record is cut.
    """
    return index if _fills(data, index) else _one_after_the_other(data, others)


def windows(data: bytes, dtype: np.dtype[np.void]) -> NDArray[np.void]:
    """Return the bytes of a record of `dtype` from every byte of the data on, as far as they fit.

    The windows overlap without a copy: element i is the stretch of `dtype.itemsize` bytes from byte
    i on. `view` makes a record of it.
    """
    return np.ndarray(
        (max(len(data) - dtype.itemsize + 1, 0),), f"V{dtype.itemsize}", data, strides=(1,)
    )


def _fills(data: bytes, index: Starts) -> bool:
    """Return whether the index names messages that fill the data from first byte to last.

    They do if the first byte is a start, if every message ends where one starts or with the data,
    and if their lengths add up to the data's: from the first byte on, one leads to the next up to
    the end, which uses up all the bytes, so there are no others. Those of a channel have to be in
    order, which is theirs in time.
    """
    if not all(np.all(of_channel[1:] > of_channel[:-1]) for of_channel in index.values()):
        return False
    starts = np.concatenate([np.empty(0, np.int64), *index.values()])
    if len(starts) == 0 or starts.min() != 0 or starts.max() + BOUNDARY.size > len(data):
        return False
    found = windows(data, _DTYPE)[starts].view(_DTYPE)
    channels = np.repeat(np.array(list(index)), [len(of_channel) for of_channel in index.values()])
    lengths = found["length"]
    if not np.all((found["opcode"] == MESSAGE_OPCODE) & (found["channel"] == channels)):
        return False
    if not np.all((lengths >= MESSAGE_HEAD) & (lengths <= len(data))):
        return False
    sizes = lengths.astype(np.int64) + RECORD_HEAD
    ends = starts + sizes
    if sizes.sum() != len(data) or ends.max() != len(data):
        return False
    boundary = np.zeros(len(data) + 1, np.bool_)
    boundary[starts] = boundary[-1] = True
    return bool(np.all(boundary[ends]))


def _one_after_the_other(data: bytes, others: Callable[[int, bytes], None] | None = None) -> Starts:
    starts: dict[int, list[int]] = {}
    position, end = 0, len(data)
    while position < end:
        if position + BOUNDARY.size > end:
            raise LogError("the last record of a chunk is cut")
        opcode, length, channel = BOUNDARY.unpack_from(data, position)
        if opcode == MESSAGE_OPCODE and length < MESSAGE_HEAD:
            raise LogError(
                f"a message in a chunk has {length} bytes, allowed: at least {MESSAGE_HEAD}"
            )
        if opcode == MESSAGE_OPCODE:
            starts.setdefault(channel, []).append(position)
        elif others and position + RECORD_HEAD + length <= end:
            others(opcode, data[position + RECORD_HEAD : position + RECORD_HEAD + length])
        position += RECORD_HEAD + length
    if position != end:
        raise LogError("the last message of a chunk is cut")
    return {channel: np.array(of_channel) for channel, of_channel in starts.items()}
