"""Files that never end, or seem to: sparse ones of 10 GB take no room on the disk."""

import struct
from pathlib import Path

import pytest

from atlas_cueing.errors import LogError
from atlas_cueing.recording import read_log
from atlas_cueing.recording import salvage as salvaging
from atlas_cueing.recording.salvage import MAX_SEARCHED, salvage

from .flights import record, tumble

HUGE = 10 * 2**30
PLENTY = 1 << 30
HEAD = 9  # bytes of a record before its content


@pytest.fixture
def log(tmp_path: Path) -> bytes:
    """Four chunks of five ticks, and one for the last state."""
    return record(tmp_path / "good.mcap", tumble(20, 100.0)).read_bytes()


def third_chunk(log: bytes) -> int:
    """Where its record starts, by the word that every chunk holds."""
    place = -1
    for _ in range(3):
        place = log.index(b"\x04\0\0\0zstd", place + 1)
    return place - 28 - HEAD


def with_hole(file: Path, log: bytes, size: int) -> Path:
    """The log with so many bytes of nothing before its third chunk."""
    place = third_chunk(log)
    with file.open("wb") as opened:
        opened.write(log[:place])
        opened.seek(size, 1)
        opened.write(log[place:])
    return file


def test_a_hole_is_looked_over(log: bytes, tmp_path: Path) -> None:
    found = salvage(with_hole(tmp_path / "x.mcap", log, 10_000_000), PLENTY)
    assert (len(found.chunks), found.complete) == (5, False)


def test_a_hole_is_not_searched_for_ever(log: bytes, tmp_path: Path) -> None:
    """The chunks behind 10 GB of nothing are not found, for nobody looks there."""
    found = salvage(with_hole(tmp_path / "x.mcap", log, HUGE), PLENTY)
    assert (len(found.chunks), found.complete) == (2, False)
    assert found.chunks[-1][1] <= third_chunk(log) < MAX_SEARCHED


def test_all_holes_together_are_bounded(
    log: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    chunk = log[third_chunk(log) :]
    chunk = chunk[: HEAD + struct.unpack_from("<xQ", chunk)[0]]
    (tmp_path / "x.mcap").write_bytes(
        log[: third_chunk(log)] + (bytes(1000) + chunk) * 10 + bytes(1000)
    )
    assert len(salvage(tmp_path / "x.mcap", PLENTY).chunks) == 12
    monkeypatch.setattr(salvaging, "MAX_SEARCHED", 4500)
    assert len(salvage(tmp_path / "x.mcap", PLENTY).chunks) == 6


@pytest.mark.parametrize(
    "head", [b"", b"\x89MCAP0\r\n" + struct.pack("<BQII", 1, 8, 0, 0)], ids=["nothing", "a header"]
)
def test_nothing_in_10_gb(head: bytes, tmp_path: Path) -> None:
    with (tmp_path / "x.mcap").open("wb") as file:
        file.write(head)
        file.truncate(HUGE)
    with pytest.raises(LogError, match="a record has no kind" if head else "no MCAP file"):
        read_log(tmp_path / "x.mcap")
    with pytest.raises(LogError, match="nothing to recover"):
        salvage(tmp_path / "x.mcap", PLENTY)


def test_a_record_of_no_kind_is_refused(log: bytes, tmp_path: Path) -> None:
    """Opcode 0, which MCAP forbids; other unknown ones are passed over, as the format has it."""
    header = len(b"\x89MCAP0\r\n")
    header += HEAD + struct.unpack_from("<xQ", log, header)[0]
    for opcode in (0, 0x80):
        (tmp_path / "x.mcap").write_bytes(
            log[:header] + struct.pack("<BQ", opcode, 0) + log[header:]
        )
        with pytest.raises(
            LogError, match="no kind" if opcode == 0 else "checksum of the data section"
        ):
            read_log(tmp_path / "x.mcap")
