"""A log reads the same whoever wrote it, and what cannot be read is said."""

import struct
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import lz4.frame
import numpy as np
import pytest
import zstandard
from google.protobuf.descriptor_pb2 import FileDescriptorSet
from mcap.writer import CompressionType

from atlas_cueing.errors import LogError
from atlas_cueing.recording import Log, read_log
from atlas_cueing.recording.compression import MAX_CHUNK
from atlas_cueing.recording.merging import merged_order, time_order
from atlas_cueing.recording.schemas import message_class
from atlas_cueing.signals import TOPICS, StateChange, tick_row

from .flights import record, tumble
from .layouts import ALL_CRCS, LAYOUTS, NO_CRCS, Item, Layout, rewritten

FELT = TOPICS[-1].fields


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(tmp_path_factory.mktemp("own") / "x.mcap", tumble(40, 100.0), chunk_ticks=7)


def check_same(one: Log, other: Log) -> None:
    """To the last bit, in everything but path and notes."""
    assert one.tables.keys() == other.tables.keys()
    for topic, table in one.tables.items():
        assert table.fields == other.tables[topic].fields
        assert table.values.tobytes() == other.tables[topic].values.tobytes(), topic
        assert table.log_times.tobytes() == other.tables[topic].log_times.tobytes(), topic
    assert one.transforms is not None
    assert other.transforms is not None
    assert one.transforms.values.tobytes() == other.transforms.values.tobytes()
    assert (one.statuses, one.metadata, one.attachments) == (
        other.statuses,
        other.metadata,
        other.attachments,
    )


@pytest.mark.parametrize("name", LAYOUTS)
def test_every_layout_reads_the_same(log: Path, tmp_path: Path, name: str) -> None:
    other = read_log(str(rewritten(log, tmp_path / "x.mcap", LAYOUTS[name])))
    check_same(read_log(log), other)
    notes = {"no checksums": 1, "no chunks, no checksums": 1, "beside others": 3}
    assert len(other.notes) == notes.get(name, 0)


def test_what_is_not_read_is_told(log: Path, tmp_path: Path) -> None:
    notes = read_log(rewritten(log, tmp_path / "x.mcap", LAYOUTS["beside others"])).notes
    assert (
        notes[0] == "/notes: 2 messages not read: encoding 'json, jsonschema', allowed: 'protobuf'"
    )
    assert notes[2] == "/tf: 2 messages not read: schema 'other.Kind'"


def test_a_log_copied_by_mcap_core() -> None:
    """Of npm, with its default options: `tumble(12, 100.0)` as `record` writes it."""
    copied, ticks = read_log(Path(__file__).with_name("by_mcap_core.mcap")), tumble(12, 100.0)
    rows = np.hstack([copied.tables[topic.name].values for topic in TOPICS[:4]])
    np.testing.assert_allclose(rows, [tick_row(tick) for tick in ticks], rtol=1e-14, atol=1e-14)
    assert copied.statuses == (
        StateChange(0.0, "running", ""),
        StateChange(0.11, "done", "end of test"),
    )
    assert copied.notes == ()


def any_damage(
    data: bytes, path: Path, change: Callable[[bytearray, int], None], places: Any, good: Log
) -> int:
    """How many of the changes are refused; the others must have changed nothing that is read."""
    refused = 0
    for place in places:
        broken = bytearray(data)
        change(broken, int(place))
        path.write_bytes(broken)
        try:
            check_same(good, read_log(path))
        except LogError:
            refused += 1
    return refused


def flip(data: bytearray, place: int) -> None:
    data[place] ^= 0x10


def cut(data: bytearray, place: int) -> None:
    del data[place:]


@pytest.mark.parametrize("name", LAYOUTS)
def test_damage_is_found_in_every_layout(log: Path, tmp_path: Path, name: str) -> None:
    layout = LAYOUTS[name]
    checked = replace(layout, options={**layout.options, **ALL_CRCS})
    data = rewritten(log, tmp_path / "x.mcap", checked).read_bytes()
    good, places = (
        read_log(tmp_path / "x.mcap"),
        np.random.default_rng(1).integers(8, len(data), 25),
    )
    assert any_damage(data, tmp_path / "y.mcap", flip, places, good) == len(places)
    bare = rewritten(
        log, tmp_path / "x.mcap", replace(layout, options={**layout.options, **NO_CRCS})
    ).read_bytes()
    places = np.linspace(0, len(bare) - 1, 25)
    assert any_damage(bare, tmp_path / "y.mcap", cut, places, good) == len(places)


def test_a_message_that_is_missing_is_found_by_the_statistics(log: Path, tmp_path: Path) -> None:
    data = rewritten(log, tmp_path / "x.mcap", LAYOUTS["no chunks, no checksums"]).read_bytes()
    start = data.index(struct.pack("<BQ", 5, 22 + 9 * len(FELT)))
    (tmp_path / "x.mcap").write_bytes(data[:start] + bytes([0x80]) + data[start + 1 :])
    with pytest.raises(LogError, match=r"its statistics have 40 messages of /felt .*; it holds 39"):
        read_log(tmp_path / "x.mcap")


def test_a_summary_in_another_place_is_found(log: Path, tmp_path: Path) -> None:
    data = bytearray(rewritten(log, tmp_path / "x.mcap", LAYOUTS["no checksums"]).read_bytes())
    footer = len(data) - 8 - 20
    data[footer] ^= 1
    (tmp_path / "x.mcap").write_bytes(data)
    with pytest.raises(LogError, match="the footer has the summary at byte"):
        read_log(tmp_path / "x.mcap")


@pytest.mark.parametrize("sized", [True, False])
def test_chunks_that_lie_about_their_size(log: Path, tmp_path: Path, sized: bool) -> None:
    """A bomb in lz4 or zstd, with or without a size in its frames, is unpacked within its claim."""
    for compression, bomb in (
        (CompressionType.LZ4, lz4.frame.compress(bytes(2 * MAX_CHUNK), store_size=sized)),
        (
            CompressionType.ZSTD,
            zstandard.ZstdCompressor(write_content_size=sized).compress(bytes(2 * MAX_CHUNK)),
        ),
    ):
        layout = Layout({"compression": compression, "chunk_size": 5000, **NO_CRCS})
        data = rewritten(log, tmp_path / "x.mcap", layout).read_bytes()
        word = compression.name.lower().encode()
        place = data.index(struct.pack("<I", len(word)) + word) - 28
        size = struct.unpack_from("<Q", data, place + 32 + len(word))[0]
        head = data[place : place + 32 + len(word)] + struct.pack("<Q", len(bomb))
        behind = data[place + len(head) + size :]
        record = struct.pack("<Q", len(head) + len(bomb)) + head + bomb
        (tmp_path / "y.mcap").write_bytes(data[: place - 8] + record + behind)
        with pytest.raises(LogError, match="another size than"):
            read_log(tmp_path / "y.mcap")


def test_frames_of_zstd_without_a_size(
    log: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As Go and Rust stream them, in several frames."""

    def compress(data: bytes) -> bytes:
        stream = zstandard.ZstdCompressor(write_content_size=False)
        return stream.compress(data[:100]) + stream.compress(data[100:])

    monkeypatch.setattr("mcap.writer.zstandard.compress", compress)
    check_same(
        read_log(log), read_log(rewritten(log, tmp_path / "x.mcap", LAYOUTS["small chunks"]))
    )


def test_a_schema_whose_files_come_in_another_order_than_they_import(
    log: Path, tmp_path: Path
) -> None:
    def backwards(items: Any) -> Any:
        for schema, channel, message in LAYOUTS["zeros left out"].change(items):
            files = FileDescriptorSet.FromString(schema.data).file
            yield (
                replace(schema, data=FileDescriptorSet(file=reversed(files)).SerializeToString()),
                channel,
                message,
            )

    check_same(read_log(log), read_log(rewritten(log, tmp_path / "x.mcap", Layout({}, backwards))))


def other_frames(items: Any) -> Any:
    """Somebody else's transforms on /tf, in the same schema."""
    for schema, channel, message in items:
        yield schema, channel, message
        if channel.topic == "/tf":
            kind = message_class(schema.name, schema.data)()
            kind.transforms.add(parent_frame_id="map", child_frame_id="odom")
            yield schema, channel, replace(message, data=kind.SerializeToString())


def turned_stage(items: Any) -> Any:
    for schema, channel, message in items:
        if channel.topic == "/tf":
            kind = message_class(schema.name, schema.data).FromString(message.data)
            kind.transforms[0].rotation.x = 0.1
            message = replace(message, data=kind.SerializeToString())
        yield schema, channel, message


def test_transforms_of_others(log: Path, tmp_path: Path) -> None:
    check_same(
        read_log(log), read_log(rewritten(log, tmp_path / "x.mcap", Layout({}, other_frames)))
    )
    with pytest.raises(LogError, match="is not base -> stage -> cabin"):
        read_log(rewritten(log, tmp_path / "x.mcap", Layout({}, turned_stage)))


@pytest.mark.parametrize(
    ("times", "rows"),
    [
        ([], []),
        ([3, 4, 1, 2], [2, 3, 0, 1]),
        ([5, 6, 3, 4, 1, 2], [4, 5, 2, 3, 0, 1]),
        ([1, 1, 2], [0, 1, 2]),
        ([1, 3, 2, 4], [0, 1, 2, 3]),  # two ticks in the wrong order are to be found
        ([1, 5, 2, 6], [0, 1, 2, 3]),
    ],
)
def test_stretches_of_a_channel_change_places_as_wholes(times: list[int], rows: list[int]) -> None:
    assert time_order(np.array(times, dtype=np.uint64)).tolist() == rows


def test_channels_are_merged_by_time() -> None:
    channels = [np.array(times, dtype=np.uint64) for times in ([1, 4, 6], [2, 3, 4])]
    assert merged_order(channels).tolist() == [0, 3, 4, 1, 5, 2]


def swapped(items: Any) -> Any:
    """Two ticks of the motion in the wrong order, with their log times."""
    kept: list[Item] = list(items)
    one, other = [k for k, item in enumerate(kept) if item[1].topic == "/motion"][20:22]
    kept[one], kept[other] = kept[other], kept[one]
    yield from kept


@pytest.mark.parametrize("options", [{}, {"chunk_size": 500}, {"use_chunking": False}])
def test_ticks_in_the_wrong_order_stay_so(
    log: Path, tmp_path: Path, options: dict[str, Any]
) -> None:
    times = read_log(rewritten(log, tmp_path / "x.mcap", Layout(options, swapped))).column(
        "/motion", "time_s"
    )
    assert np.argmin(np.diff(times)) == 20


@pytest.mark.parametrize("what", ["schema", "channel"])
def test_a_description_that_changes_is_refused(log: Path, tmp_path: Path, what: str) -> None:
    data = bytearray(
        rewritten(log, tmp_path / "x.mcap", LAYOUTS["no chunks, no checksums"]).read_bytes()
    )
    place = data.rindex(b"atlas.Felt\x08" if what == "schema" else b"/felt\x08")
    data[place + 4] ^= 1
    (tmp_path / "x.mcap").write_bytes(data)
    with pytest.raises(LogError, match=f"{what} .* is described twice, and not as the same"):
        read_log(tmp_path / "x.mcap")


def test_contents_are_bounded_in_every_layout(log: Path, tmp_path: Path) -> None:
    for name in ("mcap's own", "no chunks"):
        path = rewritten(log, tmp_path / "x.mcap", LAYOUTS[name])
        with pytest.raises(LogError, match="larger than allowed"):
            read_log(path, max_bytes=20_000)
