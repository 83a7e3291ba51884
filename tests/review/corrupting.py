"""Logs with faults put in on purpose. Whoever corrupts fails if nothing was corrupted."""

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from atlas_cueing.recording import Log, read_log
from atlas_cueing.recording.chunk import EncodedChunk
from atlas_cueing.recording.container import Container
from atlas_cueing.recording.schemas import STATUS, message_class, schema_of
from atlas_cueing.recording.wire import flat_template, log_times, put, record_template, repeat

Columns = dict[str, np.ndarray]  # "/motion wx_rad_s": values
CHUNK_TICKS = 512


def columns_of(log: Log) -> Columns:
    """Writable copies of all columns."""
    return {
        f"{t} {f}": log.column(t, f).copy() for t, table in log.tables.items() for f in table.fields
    }


def corrupted(
    source: Path,
    output: Path,
    change: Callable[[Columns], None] = lambda _: None,
    *,
    metadata: Mapping[str, str] | None = None,
    attachments: Mapping[str, bytes] | None = None,
    states: list[tuple[float, str, str]] | None = None,
) -> Path:
    """Write `source` with columns changed in place and other metadata, files or states.

    Fails if all stays as it was.
    """
    log = read_log(source)
    columns, before = columns_of(log), columns_of(log)
    change(columns)
    same = all(np.array_equal(columns[name], before[name], equal_nan=True) for name in before)
    assert not same or any(x is not None for x in (metadata, attachments, states)), (
        "the corrupter changed nothing"
    )
    told = states if states is not None else [(s.time, s.state, s.reason) for s in log.statuses]
    files = {**log.attachments, **(attachments or {})}
    write(output, log, columns, {**log.metadata, **(metadata or {})}, files, told)
    return output


def write(
    output: Path,
    log: Log,
    columns: Columns,
    metadata: Mapping[str, str],
    attachments: Mapping[str, bytes],
    states: list[tuple[float, str, str]],
) -> None:
    """A finished log of any columns, whether they make sense or not.

    It has no opinion, as the recorder has.
    """
    with output.open("wb") as file:
        container = Container(file.write)
        channels = {
            topic: container.add_channel(topic, *schema_of(topic))
            for topic in [*log.tables, STATUS]
        }
        for name, content in attachments.items():
            container.add_attachment(name, "application/toml", content)
        blocks = {
            t: np.column_stack([columns[f"{t} {f}"] for f in table.fields])
            for t, table in log.tables.items()
        }
        for start in range(0, max(len(block) for block in blocks.values()), CHUNK_TICKS):
            parts = {channels[t]: block[start : start + CHUNK_TICKS] for t, block in blocks.items()}
            container.add_chunk(
                _chunk({channel: part for channel, part in parts.items() if len(part)})
            )
        if states:
            container.add_chunk(_states(channels[STATUS], states))
        container.add_metadata("atlas.run", metadata)
        container.finish()


def _chunk(parts: Mapping[int, np.ndarray]) -> EncodedChunk:
    data, index = b"", {}
    for channel, values in parts.items():
        records = repeat(flat_template(channel, values.shape[1]), len(values))
        times = log_times(np.nan_to_num(np.clip(values[:, 0], 0.0, 1e9)))
        records["log_time"] = records["publish_time"] = times
        put(records, values)
        offsets = len(data) + records.itemsize * np.arange(len(values), dtype=np.uint64)
        index[channel] = np.stack([times, offsets], axis=1)
        data += records.tobytes()
    return EncodedChunk(data, index)


def _states(channel: int, states: list[tuple[float, str, str]]) -> EncodedChunk:
    kind = message_class(*schema_of(STATUS))
    data, index = b"", []
    for time, state, reason in states:
        log_time = int(log_times(np.array([time]))[0])
        index.append((log_time, len(data)))
        body = kind(time_s=time, state=state, reason=reason).SerializeToString()
        data += record_template(channel, body, log_time)
    return EncodedChunk(data, {channel: np.array(index, dtype=np.uint64)})
