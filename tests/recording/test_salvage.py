"""What is whole in a broken file; `tests/review/test_recover.py` recovers real flights."""

import struct
import zlib
from contextlib import nullcontext, suppress
from pathlib import Path

import pytest
import zstandard

from atlas_cueing.errors import LogError
from atlas_cueing.recording import read_log
from atlas_cueing.recording.salvage import rewrite, salvage

from .flights import record, tumble

PLENTY = 1 << 30


@pytest.fixture
def log(tmp_path: Path) -> Path:
    """Four chunks of five ticks, and one for the last state."""
    return record(tmp_path / "log.mcap", tumble(20, 100.0))


def test_a_whole_log(log: Path, tmp_path: Path) -> None:
    found = salvage(log, PLENTY)
    assert (found.complete, found.finished, len(found.chunks), found.damaged) == (True, True, 5, 0)
    assert found.metadata == read_log(log).metadata
    rewrite(found, tmp_path / "again.mcap", found.metadata)
    assert (tmp_path / "again.mcap").read_bytes() == log.read_bytes()
    assert not (tmp_path / "again.mcap.part").exists()


def test_an_unfinished_log(log: Path) -> None:
    data = log.read_bytes()
    log.write_bytes(data[: data.index(b"atlas.run") - 20])
    found = salvage(log, PLENTY)
    assert (found.complete, found.finished, len(found.chunks)) == (False, False, 5)
    assert found.metadata == {}


def test_what_it_unpacks_to_is_bounded(log: Path) -> None:
    with pytest.raises(LogError, match="unpack to more than is allowed"):
        salvage(log, 10_000)


def test_every_cut_is_survived(log: Path) -> None:
    """Cut anywhere: only whole chunks count, and never fewer in a longer part of the file."""
    data, before, count = log.read_bytes(), 0, 0
    for end in range(0, len(data), 97):
        log.write_bytes(data[:end])
        with suppress(LogError) if before == 0 else nullcontext():
            count = len(salvage(log, PLENTY).chunks)
        assert before <= count <= 5
        before = count
    assert before == 5


def test_no_file(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="cannot be read"):
        salvage(tmp_path / "missing.mcap", PLENTY)


def test_a_chunk_without_messages_is_left_out(tmp_path: Path) -> None:
    """Whole, by its checksum, and yet there is no first and last time in it."""
    data = struct.pack("<BQ2x", 7, 2) * 3
    packed = zstandard.compress(data)
    body = (
        struct.pack("<QQQII4sQ", 0, 0, len(data), zlib.crc32(data), 4, b"zstd", len(packed))
        + packed
    )
    log = record(tmp_path / "log.mcap", tumble(20, 100.0))
    whole = log.read_bytes()
    place = whole.index(b"zstd") - 41
    log.write_bytes(whole[:place] + struct.pack("<BQ", 6, len(body)) + body + whole[place:])
    found = salvage(log, PLENTY)
    assert len(found.chunks) == 6
    rewrite(found, tmp_path / "again.mcap", found.metadata)
    assert (tmp_path / "again.mcap").read_bytes() == whole
