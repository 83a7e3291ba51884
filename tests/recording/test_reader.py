"""Logs read back, and logs that are cut, damaged, hostile or of someone else."""

import io
import random
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
import zstandard
from hypothesis import given, settings
from mcap.writer import CompressionType, Writer

from atlas_cueing.errors import LogError
from atlas_cueing.recording import read_log
from atlas_cueing.recording.chunk import EncodedChunk
from atlas_cueing.recording.compression import MAX_CHUNK
from atlas_cueing.recording.container import Container
from atlas_cueing.recording.schemas import flat_schema, status_schema
from atlas_cueing.recording.wire import flat_template, record_template
from atlas_cueing.signals import TOPICS, StateChange, Tick, Topic, tick_row

from .flights import ATTACHMENTS, METADATA, any_ticks, record, tumble


@settings(max_examples=40, deadline=None)
@given(any_ticks())
def test_everything_is_read_back(
    tmp_path_factory: pytest.TempPathFactory, ticks: list[Tick]
) -> None:
    log = read_log(record(tmp_path_factory.getbasetemp() / "back.mcap", ticks))
    rows = np.hstack([log.tables[topic.name].values for topic in TOPICS[:4]])
    np.testing.assert_array_equal(rows, [tick_row(tick) for tick in ticks])
    assert [(topic.name, topic.fields) for topic in TOPICS] == [
        (name, table.fields) for name, table in log.tables.items()
    ]
    assert log.metadata == {**METADATA, "result": "ok", "reason": "end of test"}
    assert log.attachments == ATTACHMENTS
    assert log.statuses == (
        StateChange(0.0, "running", ""),
        StateChange(ticks[-1].vehicle.time, "done", "end of test"),
    )


def test_a_log_without_some_topics(tmp_path: Path) -> None:
    log = read_log(record(tmp_path / "x.mcap", tumble(8, 10.0), skip_topics=("/cue", "/status")))
    assert list(log.tables) == ["/vehicle", "/motion", "/wheels", "/felt"]
    assert log.statuses == ()


def refused(path: Path, data: bytes, why: str) -> str:
    """`data` as a log is a LogError of one line that names the file."""
    path.write_bytes(data)
    with pytest.raises(LogError, match=why) as caught:
        read_log(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_any_single_flipped_bit_is_found(tmp_path: Path) -> None:
    data = record(tmp_path / "good.mcap", tumble(6, 100.0)).read_bytes()
    randomly = random.Random(2)
    for position in (
        *range(60),
        *randomly.sample(range(len(data)), 400),
        *range(len(data) - 60, len(data)),
    ):
        broken = bytearray(data)
        broken[position] ^= 1 << randomly.randrange(8)
        assert broken != data
        refused(tmp_path / "broken.mcap", bytes(broken), ".")


def test_a_log_cut_anywhere_is_refused(tmp_path: Path) -> None:
    data = record(tmp_path / "good.mcap", tumble(6, 100.0)).read_bytes()
    for size in range(0, len(data), 13):
        refused(tmp_path / "cut.mcap", data[:size], "cut|no MCAP|end after")


def test_an_unfinished_log_is_refused(tmp_path: Path) -> None:
    data = record(tmp_path / "good.mcap", tumble(6, 100.0)).read_bytes()
    refused(tmp_path / "x.mcap.part", data[: data.index(b"atlas.run") - 13], "cut")


def test_a_log_with_something_behind_it_is_refused(tmp_path: Path) -> None:
    data = record(tmp_path / "good.mcap", tumble(6, 100.0)).read_bytes()
    refused(tmp_path / "long.mcap", data + b"\0", "does not end after its footer")


@pytest.mark.parametrize("data", [b"", b"\n", b"hello, world", b"\x89MCAP0\r\n", bytes(1000)])
def test_other_files_are_refused(tmp_path: Path, data: bytes) -> None:
    refused(tmp_path / "x", data, "cut|empty|no MCAP file")


@pytest.mark.parametrize("compression", [CompressionType.ZSTD, CompressionType.NONE])
def test_a_foreign_mcap_file_is_refused(tmp_path: Path, compression: CompressionType) -> None:
    stream = io.BytesIO()
    writer = Writer(stream, compression=compression)
    writer.start()
    schema = writer.register_schema("pose", "jsonschema", b"{}")
    channel = writer.register_channel("/pose", "json", schema)
    if compression is CompressionType.ZSTD:
        writer.add_message(channel, 1, b"{}", 1)
    writer.finish()
    refused(tmp_path / "foreign.mcap", stream.getvalue(), "no log of atlas_cueing")


def test_a_missing_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(LogError, match=r"nothing\.mcap: cannot be read: No such file"):
        read_log(tmp_path / "nothing.mcap")
    with pytest.raises(LogError, match="cannot be read: Is a directory"):
        read_log(tmp_path)


def test_the_size_of_a_log_in_memory_is_bounded(tmp_path: Path) -> None:
    path = record(tmp_path / "x.mcap", tumble(20, 100.0))
    with pytest.raises(LogError, match="larger than allowed"):
        read_log(path, max_bytes=10_000)
    assert len(read_log(path, max_bytes=100_000).column("/motion", "time_s")) == 20


def crafted(messages: bytes, packed: bytes | None = None, claimed: int | None = None) -> bytes:
    """A log whose only chunk is this, with good checksums everywhere."""
    stream = io.BytesIO()
    container = Container(stream.write)
    container.add_channel("/felt", "atlas.Felt", flat_schema(TOPICS[4]))
    container.add_metadata("atlas.run", {})
    index = {1: np.zeros((1, 2), dtype=np.uint64)}
    if packed is None:
        container.add_chunk(EncodedChunk(messages, index))
    else:
        size = len(messages) if claimed is None else claimed
        body = (
            struct.pack("<QQQII4sQ", 0, 0, size, zlib.crc32(messages), 4, b"zstd", len(packed))
            + packed
        )
        container._put(struct.pack("<BQ", 6, len(body)) + body)
    container.finish()
    return stream.getvalue()


GOOD = flat_template(1, 8).tobytes()


def test_a_crafted_log_is_read(tmp_path: Path) -> None:
    (tmp_path / "x.mcap").write_bytes(crafted(GOOD * 3))
    assert read_log(tmp_path / "x.mcap").column("/felt", "time_s").tolist() == [0.0, 0.0, 0.0]
    (tmp_path / "x.mcap").write_bytes(crafted(GOOD, zstandard.compress(GOOD)))
    assert read_log(tmp_path / "x.mcap").column("/felt", "time_s").tolist() == [0.0]


@pytest.mark.parametrize(
    ("messages", "why"),
    [
        (GOOD[:31] + b"\x0a" + GOOD[32:], "a message of /felt is damaged"),
        (record_template(1, b"\x09" + bytes(7)), "a message of /felt is damaged"),
        (
            record_template(1, b"\x0d" + bytes(4)),
            "a message of /felt is not of its schema 'atlas.Felt'",
        ),
        (record_template(7, b""), "messages of channel 7, which the log does not describe"),
        (GOOD[:-1], "the last message of a chunk is cut"),
        (GOOD + b"\x05", "the last record of a chunk is cut"),
        (GOOD + struct.pack("<BQ", 7, 0), "the last record of a chunk is cut"),
        (
            struct.pack("<BQH", 5, 2, 1) * 100,
            "a message in a chunk has 2 bytes, allowed: at least 22",
        ),
    ],
)
def test_messages_of_another_layout_are_refused(tmp_path: Path, messages: bytes, why: str) -> None:
    refused(tmp_path / "x.mcap", crafted(messages), why)


def test_a_chunk_that_would_unpack_to_a_gigabyte_is_refused(tmp_path: Path) -> None:
    bomb = zstandard.compress(bytes(MAX_CHUNK + 1))
    assert len(bomb) < 10_000
    refused(tmp_path / "x.mcap", crafted(GOOD, bomb, MAX_CHUNK + 1), "allowed: at most")
    refused(tmp_path / "x.mcap", crafted(GOOD, bomb, len(GOOD)), "another size")
    nameless = zstandard.ZstdCompressor(write_content_size=False).compress(bytes(MAX_CHUNK + 1))
    refused(tmp_path / "x.mcap", crafted(GOOD, nameless, len(GOOD)), "another size")


def test_a_chunk_that_is_not_compressed_data_is_refused(tmp_path: Path) -> None:
    refused(tmp_path / "x.mcap", crafted(GOOD, b"hello, world"), "cannot be unpacked")
    refused(
        tmp_path / "x.mcap", crafted(GOOD, zstandard.compress(GOOD[::-1])), "checksum of the chunk"
    )


def test_another_compression_is_refused_by_name(tmp_path: Path) -> None:
    stream = io.BytesIO()
    writer = Writer(stream, compression=CompressionType.LZ4, enable_data_crcs=True)
    writer.start()
    writer.add_message(writer.register_channel("/pose", "json", 0), 1, b"{}", 1)
    writer.add_metadata("atlas.run", {})
    writer.finish()
    data = stream.getvalue().replace(b"lz4", b"br7")
    refused(tmp_path / "x.mcap", data, "compression 'br7', allowed: 'zstd', 'lz4' or none")


def test_a_damaged_attachment_is_refused_by_its_own_checksum(tmp_path: Path) -> None:
    """Before anything is done with it: the checksum of the whole comes at the end."""
    stream = io.BytesIO()
    container = Container(
        lambda data: stream.write(data.replace(b"travel_m = 1.0", b"travel_m = 9.0"))
    )
    container.add_attachment("platform.toml", "application/toml", b"travel_m = 1.0")
    container.add_metadata("atlas.run", {})
    container.finish()
    refused(tmp_path / "x.mcap", stream.getvalue(), "checksum of the attachment is wrong")


def test_files_and_schemas_in_a_log_count_towards_its_size(tmp_path: Path) -> None:
    stream = io.BytesIO()
    container = Container(stream.write)
    for number in range(20):
        container.add_attachment(f"{number}.toml", "application/toml", bytes(1000))
    container.add_metadata("atlas.run", {})
    container.finish()
    (tmp_path / "x.mcap").write_bytes(stream.getvalue())
    assert len(read_log(tmp_path / "x.mcap", max_bytes=20_000).attachments) == 20
    with pytest.raises(LogError, match="content of the log is larger than allowed"):
        read_log(tmp_path / "x.mcap", max_bytes=19_000)


def test_a_state_of_other_types_is_refused(tmp_path: Path) -> None:
    """Its schema calls three doubles a time, a state and a reason."""
    stream = io.BytesIO()
    container = Container(stream.write)
    container.add_channel(
        "/status",
        "atlas.Status",
        flat_schema(Topic("/status", "atlas.Status", ("time_s", "state", "reason"))),
    )
    container.add_metadata("atlas.run", {})
    container.add_chunk(
        EncodedChunk(flat_template(1, 3).tobytes(), {1: np.zeros((1, 2), dtype=np.uint64)})
    )
    container.finish()
    refused(tmp_path / "x.mcap", stream.getvalue(), "is not a time, a state and a reason")


def test_a_schema_that_makes_no_sense_is_one_line(tmp_path: Path) -> None:
    stream = io.BytesIO()
    container = Container(stream.write)
    container.add_channel("/status", "atlas.Status", status_schema().replace(b"state", b"s\nate"))
    container.finish()
    refused(tmp_path / "x.mcap", stream.getvalue(), "damaged: .*s ate")


def test_a_record_that_claims_more_than_allowed_is_refused(tmp_path: Path) -> None:
    refused(
        tmp_path / "x.mcap",
        b"\x89MCAP0\r\n" + struct.pack("<BQ", 1, 2**40),
        "a record claims 1099511627776 bytes",
    )


def test_added_fields_and_topics_are_read(tmp_path: Path) -> None:
    stream = io.BytesIO()
    container = Container(stream.write)
    added = Topic("/torque", "atlas.Torque", tuple(f"t{i}_n_m" for i in range(20)))
    container.add_channel(added.name, added.schema, flat_schema(added))
    container.add_metadata("atlas.run", {})
    container.add_chunk(
        EncodedChunk(flat_template(1, 20).tobytes() * 2, {1: np.zeros((2, 2), dtype=np.uint64)})
    )
    container.finish()
    (tmp_path / "x.mcap").write_bytes(stream.getvalue())
    assert read_log(tmp_path / "x.mcap").tables["/torque"].fields == added.fields
    assert read_log(tmp_path / "x.mcap").column("/torque", "t19_n_m").tolist() == [0.0, 0.0]
