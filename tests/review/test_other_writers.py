"""Review, recue and recover of a log that another program wrote again.

The same figures, and the same faults.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from recording.layouts import ALL_CRCS, LAYOUTS, Layout, rewritten
from recording.test_layouts import check_same

from atlas_cueing.errors import LogError
from atlas_cueing.recording import read_log
from atlas_cueing.review import advice, cue_again, recover_log, review_log

from .conftest import fly
from .corrupting import corrupted
from .faults import FAULTS

# the others read the same, as recording/ tests
REVIEWED = ("mcap's own", "lz4", "no chunks", "zeros left out", "two channels")
# faults that a reader might mend
ODD = ("NaN", "infinite", "lost on one topic", "runs back", "late")
CHUNKS = ("lz4", "uncompressed", "small chunks")


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A clean log of 361 ticks."""
    return fly(tmp_path_factory.mktemp("own"), "duration_s=3.0")


@pytest.fixture(scope="module")
def faulty(log: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """A log with each of the faults."""
    folder = tmp_path_factory.mktemp("faults")
    return {
        name: corrupted(log, folder / f"{k}.mcap", FAULTS[name][0]) for k, name in enumerate(FAULTS)
    }


@pytest.mark.parametrize("name", LAYOUTS)
def test_recover_and_review(log: Path, tmp_path: Path, name: str) -> None:
    other = rewritten(log, tmp_path / "x.mcap", LAYOUTS[name])
    own, found = review_log(log), review_log(other)
    assert found.clean
    assert found.metrics == own.metrics
    result = recover_log(other, tmp_path / "fixed.mcap")
    assert (result.ticks, result.seconds) == (361, own.duration)
    assert result.lost == (found.notes if name == "beside others" else ())
    check_same(read_log(log), read_log(tmp_path / "fixed.mcap"))
    assert read_log(tmp_path / "fixed.mcap").notes == ()


@pytest.mark.parametrize("name", REVIEWED)
def test_recue(log: Path, tmp_path: Path, name: str) -> None:
    cue_again(
        str(rewritten(log, tmp_path / "x.mcap", LAYOUTS[name])), [], str(tmp_path / "again.mcap")
    )
    one, other = read_log(log), read_log(tmp_path / "again.mcap")
    for topic, table in one.tables.items():
        assert table.values.tobytes() == other.tables[topic].values.tobytes(), topic


@pytest.mark.parametrize("layout", REVIEWED)
def test_odd_numbers_and_times_are_read_as_they_are(
    faulty: dict[str, Path], tmp_path: Path, layout: str
) -> None:
    """A review is of what was read: the same bits, the same findings."""
    for path in (path for name, path in faulty.items() if any(word in name for word in ODD)):
        own, other = read_log(path), read_log(rewritten(path, tmp_path / "x.mcap", LAYOUTS[layout]))
        for topic, table in own.tables.items():
            assert table.values.tobytes() == other.tables[topic].values.tobytes(), (path, topic)
            assert table.log_times.tobytes() == other.tables[topic].log_times.tobytes(), (
                path,
                topic,
            )


@pytest.mark.parametrize("number", range(len(FAULTS)))
def test_every_fault_is_found(faulty: dict[str, Path], tmp_path: Path, number: int) -> None:
    """Each in one of the layouts by turns, in the words in which it is found in our own."""
    name, layout = list(FAULTS)[number], REVIEWED[number % len(REVIEWED)]
    own, found = (
        review_log(faulty[name]),
        review_log(rewritten(faulty[name], tmp_path / "x.mcap", LAYOUTS[layout])),
    )
    assert found.findings == own.findings
    assert not found.clean


def small(name: str, **options: object) -> Layout:
    """A layout in chunks of some ten ticks."""
    return Layout({**LAYOUTS[name].options, "chunk_size": 8000, **options}, LAYOUTS[name].change)


def broken(log: Path, path: Path, layout: Layout, change: Callable[[bytearray], None]) -> Path:
    data = bytearray(rewritten(log, path, layout).read_bytes())
    change(data)
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("name", [*CHUNKS, "no chunks", "zeros left out", "two channels"])
def test_a_cut_log(log: Path, tmp_path: Path, name: str) -> None:
    """What lies before the cut comes back, and is said to end there."""
    path = broken(
        log,
        tmp_path / "x.mcap",
        small(name),
        lambda data: data.__delitem__(slice(len(data) * 2 // 3, None)),
    )
    with pytest.raises(LogError):
        read_log(path)
    assert "whole; try: atlas-cueing recover" in advice(path)
    result = recover_log(path, tmp_path / "fixed.mcap")
    assert 180 < result.ticks < 300
    assert result.lost[-1].startswith("after ")
    for topic, table in read_log(tmp_path / "fixed.mcap").tables.items():
        assert len(table.values) in (result.ticks - 1, result.ticks)
        np.testing.assert_array_equal(
            table.values, read_log(log).tables[topic].values[: len(table.values)]
        )


@pytest.mark.parametrize("name", CHUNKS)
@pytest.mark.parametrize("into", [3, 9 + 24, 200], ids=["length", "crc", "data"])
def test_a_damaged_chunk(log: Path, tmp_path: Path, name: str, into: int) -> None:
    """It is left out, and the gap is told, wherever the chunk is hit.

    Those behind it are found again.
    """
    words = {"lz4": b"\x03\0\0\0lz4", "small chunks": b"\x04\0\0\0zstd"}

    def change(data: bytearray) -> None:
        if name in words:
            start = data.index(words[name], len(data) // 2) - 37
        else:
            start = data.index(b"\x06", len(data) // 2)
            while bytes(data[start + 5 : start + 9]) + bytes(
                data[start + 37 : start + 41]
            ) != bytes(8):
                start = data.index(b"\x06", start + 1)
        data[start + into] ^= 0x55

    result = recover_log(
        broken(log, tmp_path / "x.mcap", small(name), change), tmp_path / "fixed.mcap"
    )
    assert 330 < result.ticks < 361
    assert any(" s of ticks" in line for line in result.lost)
    time = read_log(tmp_path / "fixed.mcap").column("/motion", "time_s")
    assert set(time) <= set(read_log(log).column("/motion", "time_s"))


def test_a_damaged_length_of_a_message_outside_of_chunks(log: Path, tmp_path: Path) -> None:
    """One message is lost, and told; the next one is found again."""

    def change(data: bytearray) -> None:
        place = data.index(b"\x05", len(data) // 2)
        while bytes(data[place + 2 : place + 9]) != bytes(7) or data[
            place + 11 : place + 15
        ] != bytes(4):
            place = data.index(b"\x05", place + 1)
        data[place + 4] ^= 0x55

    result = recover_log(
        broken(log, tmp_path / "x.mcap", LAYOUTS["no chunks"], change), tmp_path / "fixed.mcap"
    )
    assert result.ticks == 361
    assert len(result.lost) == 2
    assert " s of ticks" in result.lost[0]
    assert result.lost[1].startswith("perhaps a number here and there")


def test_a_damaged_number_outside_of_chunks_is_doubted(log: Path, tmp_path: Path) -> None:
    def change(data: bytearray) -> None:
        data[data.index(b"\x29", len(data) // 2) + 3] ^= 1

    layout = Layout({"use_chunking": False, **ALL_CRCS})
    result = recover_log(broken(log, tmp_path / "x.mcap", layout, change), tmp_path / "fixed.mcap")
    assert result.lost == (
        (
            "perhaps a number here and there: messages outside of chunks, and a wrong checksum of"
            " the data"
        ),
    )
    assert read_log(tmp_path / "fixed.mcap").metadata["result"] == "recovered"


def test_an_unknown_compression_is_named(log: Path, tmp_path: Path) -> None:
    def all_of_them(data: bytearray) -> None:
        data[:] = data.replace(b"\x04\0\0\0zstd", b"\x04\0\0\0br-7")

    def one(data: bytearray) -> None:
        place = data.index(b"\x04\0\0\0zstd", len(data) // 2)
        data[place : place + 8] = b"\x04\0\0\0br-7"

    path = broken(log, tmp_path / "x.mcap", small("small chunks"), all_of_them)
    with pytest.raises(
        LogError, match=r"nothing to recover: .* compression 'br-7', allowed: 'zstd', 'lz4' or none"
    ):
        recover_log(path, tmp_path / "fixed.mcap")
    assert not (tmp_path / "fixed.mcap").exists()
    result = recover_log(
        broken(log, tmp_path / "x.mcap", small("small chunks"), one), tmp_path / "fixed.mcap"
    )
    assert result.ticks < 361
    assert "a chunk has compression 'br-7', allowed: 'zstd', 'lz4' or none" in result.lost


def test_a_topic_that_lost_more_than_the_others_is_told(log: Path, tmp_path: Path) -> None:
    """Chunks of one topic each: what is missing is missing of that one only."""

    def change(data: bytearray) -> None:
        data[data.index(b"\x04\0\0\0zstd", len(data) // 2) + 100] ^= 0x55

    path = broken(log, tmp_path / "x.mcap", LAYOUTS["topic by topic"], change)
    result = recover_log(path, tmp_path / "fixed.mcap")
    assert result.ticks == 361
    assert result.lost
    assert all(line.startswith("/") for line in result.lost)


def test_a_file_with_nothing_of_ours_is_refused(tmp_path: Path) -> None:
    from recording.test_foreign_schemas import written

    channel = ("/motion", "json", "atlas.Motion", "jsonschema", b"{}", [b"{}"] * 3)
    path = written(tmp_path / "x.mcap", channel)
    with pytest.raises(LogError, match=r"x\.mcap: /motion: none of its 3 messages can be read"):
        recover_log(path, tmp_path / "fixed.mcap")
    assert not (tmp_path / "fixed.mcap").exists()
