"""Where the messages of a chunk are."""

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


def message_starts(data: bytes, index: Starts) -> Starts:
    """Offset of every message in a chunk, by channel. Raises LogError where a record is cut.

    index: what the log says. It is believed only if the records it names fill the chunk without a gap; otherwise, also for
    other people's chunks with records that are no messages, one record is found after the other, which takes 20 times as long.
    """
    return index if _fills(data, index) else _one_after_the_other(data)


def _fills(data: bytes, index: Starts) -> bool:
    """Whether the index names messages that follow one another from the first byte of the data to the last."""
    if not index:
        return False
    starts = np.concatenate(list(index.values()))
    channels = np.repeat(list(index), [len(of_channel) for of_channel in index.values()])
    order = np.argsort(starts, kind="stable")
    starts, channels = starts[order], channels[order]
    if len(starts) == 0 or starts[0] != 0 or starts[-1] + BOUNDARY.size > len(data):
        return False
    windows = np.lib.stride_tricks.sliding_window_view(np.frombuffer(data, np.uint8), BOUNDARY.size)
    found = windows[starts].view(_DTYPE)[:, 0]
    lengths = found["length"]
    if not np.all((found["opcode"] == MESSAGE_OPCODE) & (found["channel"] == channels)):
        return False
    if not np.all((lengths >= MESSAGE_HEAD) & (lengths <= len(data))):
        return False
    return np.array_equal(starts + RECORD_HEAD + lengths.astype(np.int64), np.append(starts[1:], len(data)))


def _one_after_the_other(data: bytes) -> Starts:
    starts: dict[int, list[int]] = {}
    position, end = 0, len(data)
    while position < end:
        if position + BOUNDARY.size > end:
            raise LogError("the last record of a chunk is cut")
        opcode, length, channel = BOUNDARY.unpack_from(data, position)
        if opcode == MESSAGE_OPCODE and length < MESSAGE_HEAD:
            raise LogError(f"a message in a chunk has {length} bytes, allowed: at least {MESSAGE_HEAD}")
        if opcode == MESSAGE_OPCODE:
            starts.setdefault(channel, []).append(position)
        position += RECORD_HEAD + length
    if position != end:
        raise LogError("the last message of a chunk is cut")
    return {channel: np.array(of_channel) for channel, of_channel in starts.items()}
