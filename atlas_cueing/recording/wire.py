"""The fixed wire layout of the messages, with which numpy writes and reads a whole chunk at once.

A protobuf field of type double is a tag (number << 3 | 1, as a varint) and 8 bytes, little-endian
(https://protobuf.dev/programming-guides/encoding). Zeros are written too, so a message of n doubles
always has the same length; tags take one byte up to field 15 and two from field 16 on. An MCAP
message record puts an opcode, a length and a head of 22 bytes before it
(https://mcap.dev/spec#message-op0x05).
"""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array

Records = NDArray[np.void]
Times = NDArray[np.uint64]

# 2000-01-01T00:00:00Z: simulated time 0 in a log; a zero log time breaks viewers
EPOCH_NS = 946_684_800_000_000_000
LATEST_S = 1e9  # simulated times up to here fit the ns of an MCAP record with ease
MESSAGE_OPCODE = 5
RECORD_HEAD = 9  # bytes: opcode and length
HEAD = [
    ("opcode", "u1"),
    ("length", "<u8"),
    ("channel", "<u2"),
    ("sequence", "<u4"),
    ("log_time", "<u8"),
    ("publish_time", "<u8"),
]
_MESSAGE_HEAD = 22  # bytes: channel, sequence, log time, publish time
_ONE_BYTE_TAGS = 15


def log_times(time_s: Array) -> Times:
    """Return the log times (ns) of simulated times (s, finite, 0 <= t <= LATEST_S), rounded.

    Whole seconds are split off first (exactly): 1e9 times the fraction is good to 1e-7 ns, at any
    time of a flight.
    """
    seconds = np.floor(time_s)
    nanoseconds = np.rint((time_s - seconds) * 1e9)
    times: Times = (
        EPOCH_NS
        + seconds.astype(np.uint64) * np.uint64(1_000_000_000)
        + nanoseconds.astype(np.uint64)
    )
    return times


def live_log_times(elapsed_s: Array, started_ns: int) -> Times:
    """Return the log times (ns) of real times (s) since `started_ns` (ns since 1970), rounded."""
    since: Times = log_times(elapsed_s) - np.uint64(EPOCH_NS)
    return since + np.uint64(started_ns)


def record_template(channel: int, body: bytes, log_time: int = 0) -> bytes:
    """Return a whole MCAP message record with this body; sequence 0, publish time = log time."""
    head = np.array(
        (MESSAGE_OPCODE, _MESSAGE_HEAD + len(body), channel, 0, log_time, log_time), dtype=HEAD
    )
    return head.tobytes() + body


def record_content(data: bytes, offset: int) -> tuple[int, int]:
    """Return where the content of the message record at `offset` begins and ends."""
    length = int.from_bytes(data[offset + 1 : offset + RECORD_HEAD], "little")
    return offset + RECORD_HEAD + _MESSAGE_HEAD, offset + RECORD_HEAD + length


@lru_cache
def flat_dtype(fields: int) -> np.dtype[np.void]:
    """Return the layout of a message record with `fields` doubles.

    After the record's head come `near` and `far` fields of (tag, value), the far ones with tags of
    two bytes.
    """
    near = min(fields, _ONE_BYTE_TAGS)
    body: list[Any] = [("near", [("tag", "u1"), ("value", "<f8")], (near,))]
    if fields > near:
        body.append(("far", [("tag", "<u2"), ("value", "<f8")], (fields - near,)))
    return np.dtype(HEAD + body)


def flat_template(channel: int, fields: int) -> Records:
    """Return a record of `flat_dtype` with everything constant in place and zeros; shape ()."""
    dtype = flat_dtype(fields)
    template = np.zeros((), dtype)
    template["opcode"] = MESSAGE_OPCODE
    template["length"] = dtype.itemsize - RECORD_HEAD
    template["channel"] = channel
    tags = np.arange(1, fields + 1) << 3 | 1
    template["near"]["tag"] = tags[:_ONE_BYTE_TAGS]
    if fields > _ONE_BYTE_TAGS:
        far = tags[_ONE_BYTE_TAGS:]
        template["far"]["tag"] = (far & 0x7F | 0x80) | (far >> 7) << 8  # a varint of two bytes
    return template


def repeat(template: Records, count: int) -> Records:
    """Return `count` writable copies of a record of shape (), as (count,).

    The broadcast of numpy is slow for structures.
    """
    return np.frombuffer(bytearray(template.tobytes() * count), template.dtype)


def put(records: Records, values: Array) -> None:
    """Write values (n, fields) into n records of `flat_dtype`, column by column."""
    near, far = values.T[:_ONE_BYTE_TAGS], values.T[_ONE_BYTE_TAGS:]
    for part, columns in (("near", near), ("far", far)) if len(far) else (("near", near),):
        for written, column in zip(records[part]["value"].T, columns, strict=True):
            written[:] = column


@lru_cache
def _tags(fields: int) -> Records:
    """Return a record with its tags in place, to be read only."""
    return flat_template(0, fields)


def take(records: Records, fields: int) -> Array | None:
    """Return the values (n, fields) of n records of `flat_dtype`.

    They are None if any tag is not where the layout has it.
    """
    expected = _tags(fields)
    values = np.empty((len(records), fields))
    for part, columns in (("near", slice(0, _ONE_BYTE_TAGS)), ("far", slice(_ONE_BYTE_TAGS, None))):
        if part in (records.dtype.names or ()):
            if not np.all(records[part]["tag"] == expected[part]["tag"]):
                return None
            values[:, columns] = records[part]["value"]
    return values
