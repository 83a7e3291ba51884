"""Encodes a block of ticks as one MCAP chunk with its index, without a loop over messages."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..rotation import Vec3
from ..rotations import Array
from ..signals import (
    CORRECTION,
    ROW,
    TIMING,
    TOPICS,
    LoadColumns,
    Topic,
    direction_error,
    felt,
)
from .schemas import TF
from .transforms import RATE_HZ, put_transforms, transform_template
from .wire import Records, Times, flat_dtype, flat_template, put, record_content, repeat

# column of each topic in a row; /felt comes last
_STARTS = np.cumsum([0] + [len(topic.fields) for topic in TOPICS])
ELAPSED = ROW + TIMING.fields.index("elapsed_s")  # its place in a live row
_VEHICLE_F = slice(8, 11)
_MOTION = int(_STARTS[2])  # then time, q, w, alpha, p, v, a
_Q, _W, _ALPHA, _P, _A = (
    slice(_MOTION + start, _MOTION + end)
    for start, end in ((1, 5), (5, 8), (8, 11), (11, 14), (17, 20))
)


class Extra(NamedTuple):
    """A message that does not come every tick.

    ticks: number of ticks of its chunk that it stands after.
    channel: id of its channel.
    log_time: ns.
    record: the whole message record.
    """

    ticks: int
    channel: int
    log_time: int
    record: bytes


class _Extras(NamedTuple):
    """Messages as `Extra` has them, column by column (n,), in the order of the file."""

    ticks: NDArray[np.int64]
    channels: NDArray[np.int64]
    log_times: Times
    records: list[bytes]

    def with_statuses(self, statuses: Sequence[Extra]) -> "_Extras":
        """Return these messages and changes of state, in order of place and log time."""
        ticks, channels, log_times, records = zip(*statuses, strict=True)
        places = np.concatenate([self.ticks, np.array(ticks, np.int64)])
        times = np.concatenate([self.log_times, np.array(log_times, np.uint64)])
        order, every = np.lexsort((times, places)), [*self.records, *records]
        return _Extras(
            places[order],
            np.concatenate([self.channels, np.array(channels, np.int64)])[order],
            times[order],
            [every[k] for k in order.tolist()],
        )


@dataclass(frozen=True, slots=True)
class EncodedChunk:
    """A chunk before its compression.

    data: message records.
    index: log time (ns) and offset in `data` (n, 2) of each message, by channel.
    """

    data: bytes
    index: dict[int, NDArray[np.uint64]]

    def messages(self) -> Iterator[tuple[int, int, bytes]]:
        """Yield channel, log time (ns) and content of each message, channel by channel."""
        for channel, entries in self.index.items():
            for log_time, offset in entries.tolist():
                start, end = record_content(self.data, offset)
                yield channel, log_time, self.data[start:end]


class ChunkEncoder:
    """Encodes blocks of ticks as chunks."""

    def __init__(self, channels: Mapping[str, int], topics: Sequence[Topic] = TOPICS) -> None:
        """Lay out the messages of a tick.

        Args:
            channels: ids by the names of the topics to write; the others are left out.
            topics: in the order of a row: TOPICS, or LIVE_TOPICS for a live log.
        """
        self._tf_channel = channels.get(TF)
        self._tf_template = transform_template(channels.get(TF, 0))
        self._tf_slot = -1.0
        self._channels = channels
        sizes = {t.name: len(t.fields) for t in topics}
        ends = np.cumsum(list(sizes.values())).tolist()
        self._columns = {
            name: slice(end - sizes[name], end)
            for name, end in zip(sizes, ends, strict=True)
            if name in channels
        }
        sizes = {name: size for name, size in sizes.items() if name in channels}
        self._template = np.zeros(
            (), np.dtype([(name, flat_dtype(size)) for name, size in sizes.items()])
        )
        self._offsets: dict[str, int] = {}  # of each message in a tick
        offset = 0
        for name, size in sizes.items():
            self._template[name] = flat_template(channels[name], size)
            self._offsets[name] = offset
            offset += flat_dtype(size).itemsize
        # used again for every chunk, without new memory
        self._records = repeat(self._template, 0)

    def encode(self, ticks: Array, times: Times, statuses: Sequence[Extra]) -> EncodedChunk:
        """Encode ticks in order of time.

        Args:
            ticks: (n, fields of all topics); /tf is made from them.
            times: log times (n,), ns.
            statuses: changes of state among them.
        """
        records = self._encode_ticks(ticks, times)
        extras = self._transforms(ticks, times)
        if statuses:
            extras = extras.with_statuses(statuses)
        return EncodedChunk(_merge(records, extras), self._index(records, times, extras))

    def _encode_ticks(self, ticks: Array, times: Times) -> Records:
        """Return a structured record a tick with all its messages, valid until the next call."""
        if len(self._records) < len(ticks):
            self._records = repeat(self._template, len(ticks))
        records = self._records[: len(ticks)]
        for name, columns in self._columns.items():
            records[name]["log_time"] = records[name]["publish_time"] = times
            put(records[name], ticks[:, columns])
        return records

    def _transforms(self, ticks: Array, times: Times) -> _Extras:
        """Make a /tf message after each tick that is the first one in its sixtieth of a second."""
        due = self._due(ticks[:, 0])
        records = repeat(self._tf_template, len(due))
        put_transforms(records, times[due], ticks[due, _Q], ticks[due, _P])
        data, size = records.tobytes(), records.itemsize
        each = [data[start : start + size] for start in range(0, len(data), size)]
        return _Extras(due + 1, np.full(len(due), self._tf_channel or 0), times[due], each)

    def _due(self, times: Array) -> NDArray[np.int64]:
        """Return which ticks, of these times (s), have a /tf message after them."""
        if self._tf_channel is None or not len(times):
            return np.empty(0, np.int64)
        # a tick due at k/60 s may be a rounding error early
        slots = np.floor(times * RATE_HZ + 1e-6)
        due = np.flatnonzero(np.diff(slots, prepend=self._tf_slot))
        self._tf_slot = float(slots[-1])
        return due

    def _index(self, ticks: Records, times: Times, extras: _Extras) -> dict[int, Times]:
        """Return log time and offset of each message, by channel.

        A tick is moved back by the extra messages before it, and they by the ticks before them.
        """
        sizes = np.cumsum([0, *map(len, extras.records)])
        count = np.arange(len(ticks))
        bases = count * ticks.itemsize + sizes[np.searchsorted(extras.ticks, count, side="right")]
        index = {}
        for name, offset in self._offsets.items() if len(ticks) else ():
            index[self._channels[name]] = _entries(times, bases + offset)
        entries = _entries(extras.log_times, extras.ticks * ticks.itemsize + sizes[:-1])
        for channel in sorted(set(extras.channels.tolist())):  # np.unique would load numpy.ma
            index[channel] = entries[extras.channels == channel]
        return index


def with_felt(rows: Array, head_S: Vec3) -> Array:
    """Append the fields of /felt to rows (n, ROW or LIVE_ROW); head_S in m, frame S.

    Column by column in memory: from here on each is worked upon by itself.
    """
    count, width = rows.shape
    ticks = np.empty((count, width + len(TOPICS[-1].fields)), order="F")
    ticks[:, :width] = rows
    ticks[:, width:] = felt_columns(ticks, head_S)
    return ticks


def with_loads(ticks: Array, loads: LoadColumns) -> Array:
    """Append the fields of /loads to ticks (n, fields of TOPICS or of LIVE_TOPICS)."""
    columns = loads(ticks[:, _Q], ticks[:, _W], ticks[:, _ALPHA], ticks[:, _A])
    return np.column_stack([ticks, ticks[:, _MOTION], columns])


def with_attitude(ticks: Array, rows: Array) -> Array:
    """Append the fields of /correction and /estimate to ticks; rows (n, ATTITUDE_ROW)."""
    time, size = ticks[:, _MOTION], len(CORRECTION.fields) - 1
    return np.column_stack([ticks, time, rows[:, :size], time, rows[:, size:]])


def felt_columns(rows: Array, head_S: Vec3) -> Array:
    """Return the fields of /felt (n, 8) of rows (n, ROW): time, force, rate, direction error."""
    with np.errstate(all="ignore"):  # a number that overflowed upstream is recorded as it is
        f, w = felt(rows[:, _Q], rows[:, _W], rows[:, _ALPHA], rows[:, _A], head_S)
        error = direction_error(rows[:, _VEHICLE_F], f)
    return np.column_stack([rows[:, _MOTION], f, w, error])


def _entries(times: Times, offsets: NDArray[np.int64]) -> Times:
    """Return entries (n, 2) of an index."""
    return np.stack([times, offsets.astype(np.uint64)], axis=1)


def _merge(ticks: Records, extras: _Extras) -> bytes:
    """Return the bytes of the ticks with each extra record at its place."""
    data, start = ticks.view(np.uint8).data, 0
    pieces: list[bytes | memoryview] = []
    for end, record in zip((extras.ticks * ticks.itemsize).tolist(), extras.records, strict=True):
        pieces += [data[start:end], record]
        start = end
    return b"".join([*pieces, data[start:]])
