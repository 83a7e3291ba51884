"""Summary, indexes and chunks of a log, as plain mcap reads them."""

import io
from collections import Counter
from pathlib import Path

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.reader import SeekingReader, make_reader
from mcap.records import Chunk, Footer, Message, MessageIndex, SummaryOffset

from atlas_cueing.signals import TOPICS

from .flights import record, tumble
from .plain_reading import decoded, open_recorder


def test_summary_agrees_with_the_messages(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(23, 100.0))
    with path.open("rb") as stream:
        summary = SeekingReader(stream, validate_crcs=True).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    topics = {channel.id: channel.topic for channel in summary.channels.values()}
    counts = {
        topics[key]: count for key, count in summary.statistics.channel_message_counts.items()
    }
    messages = list(decoded(path))
    times = [log_time for _, log_time, _ in messages]
    assert counts == Counter(topic for topic, _, _ in messages)
    assert summary.statistics.message_count == len(messages)
    assert (summary.statistics.message_start_time, summary.statistics.message_end_time) == (
        min(times),
        max(times),
    )
    assert (summary.statistics.chunk_count, len(summary.chunk_indexes)) == (5, 5)
    assert (summary.statistics.attachment_count, summary.statistics.metadata_count) == (2, 1)
    assert summary.statistics.channel_count == summary.statistics.schema_count == len(TOPICS) + 2
    assert len(summary.attachment_indexes) == 2
    assert len(summary.metadata_indexes) == 1


def record_at(data: bytes, offset: int, opcode: int) -> ReadDataStream:
    """The body of the record at `offset`, which must have this opcode."""
    assert data[offset] == opcode
    length = int.from_bytes(data[offset + 1 : offset + 9], "little")
    return ReadDataStream(io.BytesIO(data[offset + 9 : offset + 9 + length]))


def test_indexes_point_at_every_message(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(23, 100.0))
    data = path.read_bytes()
    with path.open("rb") as stream:
        summary = SeekingReader(stream).get_summary()
    assert summary is not None
    indexed = 0
    for chunk_index in summary.chunk_indexes:
        chunk = Chunk.read(record_at(data, chunk_index.chunk_start_offset, Opcode.CHUNK))
        messages = zstandard.decompress(chunk.data)
        assert len(messages) == chunk_index.uncompressed_size
        assert len(chunk.data) == chunk_index.compressed_size
        end = (
            chunk_index.chunk_start_offset
            + chunk_index.chunk_length
            + chunk_index.message_index_length
        )
        # what comes after the last message index
        assert data[end] in (Opcode.CHUNK, Opcode.METADATA)
        times = []
        for channel, offset in chunk_index.message_index_offsets.items():
            index = MessageIndex.read(record_at(data, offset, Opcode.MESSAGE_INDEX))
            assert index.channel_id == channel
            for log_time, start in index.records:
                message = Message.read(record_at(messages, start, Opcode.MESSAGE), 22)
                assert (message.channel_id, message.log_time) == (channel, log_time)
                times.append(log_time)
        assert (chunk_index.message_start_time, chunk_index.message_end_time) == (
            min(times),
            max(times),
        )
        indexed += len(times)
    assert summary.statistics is not None
    assert indexed == summary.statistics.message_count


def test_summary_offsets_point_at_their_groups(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(23, 100.0))
    data = path.read_bytes()
    footer = Footer.read(record_at(data, len(data) - 8 - 29, Opcode.FOOTER))
    position, groups = footer.summary_offset_start, []
    while data[position] == Opcode.SUMMARY_OFFSET:
        group = SummaryOffset.read(record_at(data, position, Opcode.SUMMARY_OFFSET))
        assert data[group.group_start] == group.group_opcode
        groups.append((group.group_start, group.group_length))
        position += 9 + 17
    ends = [start + length for start, length in groups]
    assert len(groups) == 6
    assert [footer.summary_start, *ends] == [
        *(start for start, _ in groups),
        footer.summary_offset_start,
    ]


def test_a_log_without_ticks_is_complete(tmp_path: Path) -> None:
    recorder = open_recorder(tmp_path / "empty.mcap")
    recorder.close("vehicle_failed", "no trim")
    assert list(decoded(tmp_path / "empty.mcap")) == []
    with (tmp_path / "empty.mcap").open("rb") as stream:
        assert (
            next(iter(make_reader(stream).iter_metadata())).metadata["result"] == "vehicle_failed"
        )
