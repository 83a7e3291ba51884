"""Writes a log in memory, by any writer, in the layout of this program."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ..signals import ALL_TOPICS, Topic
from .chunk import EncodedChunk
from .container import Container
from .log import Log, TopicColumns
from .recorder import RUN_METADATA
from .schemas import STATUS, TF, flat_schema, message_class, schema_of
from .transforms import put_transforms, transform_template
from .wire import LATEST_S, Records, Times, flat_template, log_times, put, record_template, repeat

CHUNK_TICKS = 512


@dataclass(frozen=True, slots=True)
class _Stream:
    """The messages of a channel.

    channel: its id.
    times: log times (n,), ns.
    encode: returns the records of a range of them.
    """

    channel: int
    times: Times
    encode: Callable[[slice], list[bytes]]

    def cuts(self, starts: Times) -> list[int]:
        """Return where the chunks that begin at log times `starts` cut the messages."""
        inner = np.searchsorted(np.maximum.accumulate(self.times), starts[1:])
        return [0, *inner.tolist(), len(self.times)]


def write_log(container: Container, log: Log, metadata: Mapping[str, str]) -> None:
    """Write columns, states, poses and files of `log` into the empty `container`, and finish it.

    Log times and the order of the messages of a topic are kept.

    Raises what the container's `write` raises.
    """
    streams = [_numbers(container, topic, table) for topic, table in log.tables.items()]
    streams += [_poses(container, log.transforms)] if log.transforms is not None else []
    streams += [_states(container, log)] if log.statuses else []
    for name, content in log.attachments.items():
        container.add_attachment(name, "application/toml", content)
    longest = max((stream.times for stream in streams), key=len, default=np.empty(0, np.uint64))
    starts = np.maximum.accumulate(longest)[::CHUNK_TICKS]
    cuts = [stream.cuts(starts) for stream in streams]
    for k in range(len(starts)):
        chunk = _chunk(
            [(stream, slice(*cut[k : k + 2])) for stream, cut in zip(streams, cuts, strict=True)]
        )
        if chunk.index:
            container.add_chunk(chunk)
    container.add_metadata(RUN_METADATA, metadata)
    container.finish()


def _chunk(parts: list[tuple[_Stream, slice]]) -> EncodedChunk:
    """Encode a range of each stream as one chunk, a channel after the other."""
    pieces, index, position = [], {}, 0
    for stream, rows in parts:
        records = stream.encode(rows)
        if not records:
            continue
        ends = position + np.cumsum([len(record) for record in records])
        offsets = np.concatenate([[position], ends[:-1]]).astype(np.uint64)
        index[stream.channel] = np.stack([stream.times[rows], offsets], axis=1)
        pieces += records
        position = int(ends[-1])
    return EncodedChunk(b"".join(pieces), index)


def _numbers(container: Container, topic: str, table: TopicColumns) -> _Stream:
    known = {each.name: each.schema for each in ALL_TOPICS}
    name = known.get(topic, "atlas." + re.sub(r"\W", "_", topic.strip("/")).title())
    channel = container.add_channel(topic, name, flat_schema(Topic(topic, name, table.fields)))
    template = flat_template(channel, len(table.fields))

    def encode(rows: slice) -> list[bytes]:
        """Encode the numbers of these rows as message records."""
        records = repeat(template, len(table.values[rows]))
        records["log_time"] = records["publish_time"] = table.log_times[rows]
        put(records, table.values[rows])
        return _each(records)

    return _Stream(channel, table.log_times, encode)


def _poses(container: Container, table: TopicColumns) -> _Stream:
    channel = container.add_channel(TF, *schema_of(TF))
    template = transform_template(channel)

    def encode(rows: slice) -> list[bytes]:
        """Encode the poses of these rows as message records."""
        records = repeat(template, len(table.values[rows]))
        put_transforms(
            records, table.log_times[rows], table.values[rows, 3:], table.values[rows, :3]
        )
        return _each(records)

    return _Stream(channel, table.log_times, encode)


def _states(container: Container, log: Log) -> _Stream:
    channel = container.add_channel(STATUS, *schema_of(STATUS))
    times, kind = _state_times(log), message_class(*schema_of(STATUS))
    bodies = [
        kind(time_s=s.time, state=s.state, reason=s.reason).SerializeToString()
        for s in log.statuses
    ]
    records = [
        record_template(channel, body, time)
        for body, time in zip(bodies, times.tolist(), strict=True)
    ]
    return _Stream(channel, times, lambda rows: records[rows])


def _state_times(log: Log) -> Times:
    """Return the log times of the states: each has that of the last tick up to it."""
    seconds = np.array([status.time for status in log.statuses])
    ticks = next(
        (t for t in log.tables.values() if t.fields[:1] == ("time_s",) and len(t.values)), None
    )
    if ticks is None:
        return log_times(np.nan_to_num(seconds).clip(0.0, LATEST_S))
    row = np.searchsorted(np.maximum.accumulate(ticks.values[:, 0]), seconds, side="right") - 1
    times: Times = ticks.log_times[row.clip(0)]
    return times


def _each(records: Records) -> list[bytes]:
    data, size = records.tobytes(), records.itemsize
    return [data[start : start + size] for start in range(0, len(data), size)]
