"""`atlas-cueing recover` as its users see it."""

import json
from pathlib import Path

import pytest

from .conftest import Command


@pytest.fixture
def cut(command: Command, tmp_path: Path) -> Path:
    """A log cut in its third chunk of 16 ticks."""
    assert command("run", "s.toml", "--set", "recording.chunk_ticks=16").status == 0
    data = (tmp_path / "short.mcap").read_bytes()
    places = [
        place
        for place in range(len(data))
        if data.startswith(b"\x04\0\0\0zstd", place) and data[place - 37] == 6
    ]
    (tmp_path / "short.mcap").unlink()
    (tmp_path / "cut.mcap").write_bytes(data[: places[2] + 100])
    return tmp_path / "cut.mcap"


def test_for_people(command: Command, cut: Path) -> None:
    ended = command("recover", cut.name, "-o", "fixed.mcap")
    assert (ended.status, ended.err) == (0, "")
    assert ended.out.splitlines() == [
        "log        fixed.mcap",
        "recovered  0.26 s, 32 ticks",
        "lost       after 0.258333 s: whatever there was; the log has no end",
    ]
    assert command("review", "fixed.mcap").status == 1


def test_for_programs(command: Command, cut: Path) -> None:
    table = json.loads(command("recover", cut.name, "-o", "fixed.mcap", "--json").out)
    assert (table["ticks"], table["log"], len(table["lost"])) == (32, "fixed.mcap", 1)


def test_a_whole_log(command: Command) -> None:
    command("run", "s.toml")
    assert (
        command("recover", "short.mcap", "-o", "copy.mcap").out.splitlines()[-1]
        == "lost       nothing"
    )
    assert command("review", "copy.mcap").status == 0


def test_bad_usage_writes_nothing(command: Command, cut: Path, tmp_path: Path) -> None:
    before = cut.read_bytes()
    for arguments, message in (
        (["missing.mcap", "-o", "fixed.mcap"], "no such file"),
        (["cut.mcap", "-o", "cut.mcap"], "is a file that is read"),
        (["cut.mcap", "-o", "cut.mcap", "--force"], "is a file that is read"),
        (["cut.mcap", "-o", "no/fixed.mcap"], "there is no folder"),
    ):
        ended = command("recover", *arguments)
        assert (ended.status, ended.out) == (2, "")
        assert message in ended.err
    assert cut.read_bytes() == before
    assert {path.name for path in tmp_path.iterdir()} == {"s.toml", "cut.mcap"}


def test_nothing_to_recover(command: Command, tmp_path: Path) -> None:
    (tmp_path / "text.mcap").write_text("no log")
    ended = command("recover", "text.mcap", "-o", "fixed.mcap")
    assert (ended.status, ended.out) == (1, "")
    assert ended.err.startswith("error: text.mcap: there is nothing to recover")
    assert not (tmp_path / "fixed.mcap").exists()
