"""Where the commands write: beside the real file, never onto an input or something else."""

import errno
import json
import os
from pathlib import Path

import pytest

from atlas_cueing import atomic_file as whole_file

from .conftest import Command


@pytest.fixture
def log(command: Command, tmp_path: Path) -> Path:
    assert command("run", "s.toml").status == 0
    return tmp_path / "short.mcap"


@pytest.mark.parametrize(
    ("words", "old"),
    [
        (["run", "s.toml", "-o", "link"], "log"),
        (["recue", "short.mcap", "-o", "link"], "log"),
        (["recover", "short.mcap", "-o", "link"], "log"),
        (["review", "short.mcap", "--html", "link"], "page"),
        (["review", "short.mcap", "--replay", "link"], "page"),
        (["compare", "short.mcap", "twin.mcap", "--html", "link"], "page"),
        (["live", "s.toml", "--duration", "0.1", "-o", "link"], "log"),
    ],
    ids=lambda words: " ".join(words) if isinstance(words, list) else "",
)
def test_a_link_stays_and_leads_to_the_output(
    command: Command, log: Path, words: list[str], old: str
) -> None:
    """Dangling at first, then to what --force may replace."""
    folder = log.parent
    (folder / "twin.mcap").write_bytes(log.read_bytes())
    (folder / "there").mkdir()
    (folder / "link").symlink_to("there/real")
    for force in ([], ["--force"]):
        assert command(*words, *force).status in (0, 1)
        assert (folder / "link").is_symlink()
        assert [path.name for path in (folder / "there").iterdir()] == ["real"]
        begin = (folder / "there" / "real").read_bytes()[:40]
        assert begin.startswith(b"\x89MCAP" if old == "log" else whole_file.PAGE_BEGINS.encode())


def test_a_page_does_not_replace_a_log_nor_a_log_a_page(command: Command, log: Path) -> None:
    before = log.read_bytes()
    (log.parent / "other.mcap").write_bytes(before)
    ended = command("review", "short.mcap", "--html", "other.mcap", "--force")
    assert (ended.status, ended.out) == (2, "")
    assert "is no page of atlas-cueing, and nothing else is replaced" in ended.err
    command("review", "short.mcap", "--html", "page.html")
    assert command("run", "s.toml", "-o", "page.html", "--force").status == 2
    assert (log.parent / "other.mcap").read_bytes() == before


def test_a_log_that_appears_in_mid_run_stays(
    command: Command, log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    log.unlink()
    finish = whole_file.Destination.take

    def late(self: whole_file.Destination, part: Path) -> None:
        self.path.write_text("of another")
        finish(self, part)

    monkeypatch.setattr(whole_file.Destination, "take", late)
    ended = command("run", "s.toml", "--json")
    assert ended.status == 1
    assert "another file has taken its name meanwhile" in ended.err
    assert json.loads(ended.out)["log"] == "short.mcap.part"
    assert log.read_text() == "of another"


@pytest.mark.parametrize("name", ["index.html", "summary.csv"])
def test_a_batch_replaces_only_its_own(command: Command, tmp_path: Path, name: str) -> None:
    (tmp_path / "site").mkdir()
    (tmp_path / "site" / name).write_text("precious")
    ended = command("batch", "s.toml", "-o", "site", "--jobs", "1")
    assert ended.status == 2
    assert f"site/{name}: is no " in ended.err
    assert [path.name for path in (tmp_path / "site").iterdir()] == [name]
    (tmp_path / "site" / name).unlink()
    for _ in range(2):
        assert command("batch", "s.toml", "-o", "site", "--jobs", "1").status == 0


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EROFS])
def test_what_the_system_refuses_is_no_bug(
    command: Command, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError(number, os.strerror(number), "scratch")

    monkeypatch.setattr("tempfile.mkdtemp", refuse)
    ended = command("run", "s.toml")
    assert (ended.status, ended.err) == (1, f"error: scratch: {os.strerror(number)}\n")
