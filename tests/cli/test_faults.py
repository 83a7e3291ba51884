"""Disks that fill up, folders that go, two runs at once, signals.

A message, and what was recorded can be read.
"""

import os
import resource
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from atlas_cueing.recording import read_log
from atlas_cueing.run import fly as run_module
from atlas_cueing.run.ticks import BLOCK

from .conftest import SCRIPT, Command

COMMAND = [
    sys.executable,
    "-W",
    "error",
    "-c",
    "import sys; from atlas_cueing.cli import main; sys.exit(main())",
]
LONG = SCRIPT.replace("0.45", "30.0") + "[recording]\nchunk_ticks = 64\n"
ROOM = 200_000  # bytes; a tenth of the log


def at_block(monkeypatch: pytest.MonkeyPatch, number: int, deed: object) -> None:
    """Do the deed when a run has kept so many blocks of ticks."""
    keep, kept = run_module.RunLog.add, []

    def keeping(self: object, states: object) -> None:
        keep(self, states)  # type: ignore[arg-type]
        kept.append(1)
        if len(kept) == number:
            deed()  # type: ignore[operator]

    monkeypatch.setattr(run_module.RunLog, "add", keeping)


def test_a_full_disk(tmp_path: Path, command: Command) -> None:
    (tmp_path / "s.toml").write_text(LONG)
    ended = subprocess.run(
        [*COMMAND, "run", "s.toml"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300.0,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (ROOM, ROOM)),
    )
    assert ended.returncode == 1
    assert "recording_failed: cannot write log short.mcap: File too large" in ended.stderr
    assert "Traceback" not in ended.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["s.toml", "short.mcap.part"]
    assert command("recover", "short.mcap.part", "-o", "saved.mcap").status == 0
    time = read_log(tmp_path / "saved.mcap").column("/motion", "time_s")
    assert len(time) >= 64
    assert len(time) % 64 == 0


def test_the_folder_goes_in_mid_run(
    tmp_path: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "s.toml").write_text(LONG)
    (tmp_path / "out").mkdir()
    at_block(monkeypatch, 2, lambda: shutil.rmtree(tmp_path / "out"))
    ended = command("run", "s.toml", "-o", "out/x.mcap", "--set", "duration_s=10")
    assert ended.status == 1
    assert ended.err == "recording_failed: cannot write log out/x.mcap: No such file or directory\n"
    assert not (tmp_path / "out").exists()


def test_a_second_run_on_the_same_log_is_refused_while_the_first_goes_on(
    tmp_path: Path, command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    second = []
    at_block(monkeypatch, 1, lambda: second.append(command("run", "s.toml")))
    assert command("run", "s.toml").status == 0
    (ended,) = second
    assert ended.status == 2
    assert "short.mcap.part is there, of a run that is still going or was killed" in ended.err
    assert len(read_log(tmp_path / "short.mcap").column("/motion", "time_s")) == 55


def test_what_a_killed_run_left_is_not_overwritten(tmp_path: Path, command: Command) -> None:
    (tmp_path / "short.mcap.part").write_bytes(b"\x89MCAP precious")
    ended = command("run", "s.toml")
    assert (ended.status, ended.out) == (2, "")
    assert "atlas-cueing recover short.mcap.part -o" in ended.err
    assert (tmp_path / "short.mcap.part").read_bytes() == b"\x89MCAP precious"
    assert command("run", "s.toml", "--force").status == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["s.toml", "short.mcap"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_asked_to_stop(
    tmp_path: Path, command: Command, monkeypatch: pytest.MonkeyPatch, number: signal.Signals
) -> None:
    (tmp_path / "s.toml").write_text(LONG)
    at_block(monkeypatch, 3, lambda: signal.raise_signal(number))
    ended = command("run", "s.toml")
    assert ended.status == 1
    assert ended.err.startswith("interrupted: asked to stop at ")
    log = read_log(tmp_path / "short.mcap")
    assert log.metadata["result"] == "interrupted"
    assert 3 * BLOCK <= len(log.column("/motion", "time_s")) <= 4 * BLOCK


def test_killed(tmp_path: Path, command: Command) -> None:
    """Every chunk that was full by then can be had back."""
    (tmp_path / "s.toml").write_text(LONG)
    killing = (
        "import os, sys; from atlas_cueing.run import fly as r; from atlas_cueing.cli import"
        " main; keep = r.RunLog.add\ndef k(self, states):\n keep(self, states)\n if"
        " self.ticks > 600: os.kill(os.getpid(), 9)\nr.RunLog.add = k\nsys.exit(main())"
    )
    ended = subprocess.run(
        [sys.executable, "-c", killing, "run", "s.toml"],
        cwd=tmp_path,
        capture_output=True,
        timeout=300.0,
        check=False,
    )
    assert ended.returncode == -signal.SIGKILL
    assert sorted(path.name for path in tmp_path.iterdir()) == ["s.toml", "short.mcap.part"]
    assert command("recover", "short.mcap.part", "-o", "saved.mcap").status == 0
    flown = -(-601 // BLOCK) * BLOCK
    assert len(read_log(tmp_path / "saved.mcap").column("/motion", "time_s")) == flown // 64 * 64


@pytest.mark.skipif(os.geteuid() == 0, reason="needs a user who may not write everywhere")
def test_a_folder_of_somebody_else(tmp_path: Path, command: Command) -> None:
    (tmp_path / "mine").mkdir(mode=0o500)
    ended = command("run", "s.toml", "-o", "mine/x.mcap")
    assert (ended.status, ended.err) == (
        2,
        "error: log mine/x.mcap: folder mine cannot be written to\n",
    )
