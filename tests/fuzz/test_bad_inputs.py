"""Some of what `tools/bad_inputs` tries, and that it would tell if anything went wrong."""

import os
import runpy
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import FrameType

import pytest
import zstandard

from atlas_cueing.cli import main

from . import bad_files, bad_logs, bad_outputs, bad_paths, bad_recordings, trying
from .bad_files import SCENARIO
from .bad_inputs import bad_inputs
from .trying import BadInput, Ended, attempt, good_log, missing, objections, prepare

TOOL = Path(__file__).parents[2] / "tools" / "bad_inputs"
STUCK = 200  # s; what waits for a pipe waits for ever
WELL = Ended(status=2, seconds=0.1, megabytes=60.0, message="error: x: no", written=())
REFUSED = BadInput("x", ("run", "x"))


@pytest.fixture(scope="session")
def log() -> bytes:
    return good_log(SCENARIO)


@contextmanager
def at_most(seconds: int) -> Iterator[None]:
    def stop(_number: int, _frame: FrameType | None) -> None:
        raise TimeoutError("stuck")

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


HERE = [*bad_files.TEXTS, *bad_files.OVERRIDES, *bad_files.PLATFORMS, *bad_paths.PATHS]
HERE += bad_recordings.RECORDINGS
# tests/recording/test_endless.py looks at what has GBs
HERE += [bad for bad in bad_logs.NOT_THERE if "GB" not in bad.name]


@pytest.mark.parametrize("bad", HERE, ids=lambda bad: bad.name[:60])
def test_it_is_refused_at_once(
    bad: BadInput,
    log: bytes,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Without starting a process for each: a hundred of them."""
    prepare(bad, tmp_path, SCENARIO, log)
    monkeypatch.chdir(tmp_path)
    before = set(os.listdir())
    with at_most(STUCK):
        status = main(bad.arguments)
    written = tuple(set(os.listdir()) - before)
    assert objections(bad, Ended(status, 0.0, 0.0, capsys.readouterr().err, written)) == []


CHOSEN = [
    "sweeps/10,000 runs, the last one wrong",
    "scripts/entity bomb",
    "logs/review: bomb of 2 GB",
    "disks/run to a full disk",
]


@pytest.mark.parametrize("name", CHOSEN)
def test_the_command_itself_ends_as_it_ought_to(
    name: str, log: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(trying, "_start_up", lambda _: 0.0)
    kind, _, which = name.partition("/")
    (bad,) = [bad for bad in bad_inputs(log)[kind] if bad.name == which]
    if missing(bad):
        pytest.skip(f"needs {missing(bad)}")
    # the machine may be busy
    unhurried = replace(bad, limits=replace(bad.limits, seconds=10 * bad.limits.seconds))
    assert objections(unhurried, attempt(bad, SCENARIO, log)) == []


def test_there_are_hundreds_and_each_has_a_name(log: bytes) -> None:
    every = [
        (kind, bad.name, bad.arguments)
        for kind, inputs in bad_inputs(log).items()
        for bad in inputs
    ]
    assert len(every) > 200
    assert len({(kind, name) for kind, name, _ in every}) == len(every)


def test_the_bombs_are_what_they_claim() -> None:
    assert zstandard.ZstdDecompressor().decompress(bad_logs._packed(3 << 20)) == bytes(3 << 20)
    assert len(bad_logs._packed(2 << 30)) < 100_000


def test_bad_logs_are_not_the_good_one(log: bytes) -> None:
    assert all(content != log for content in bad_logs.damaged(log).values())


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"status": 1}, "status 1, not 2"),
        ({"message": "Traceback (most recent call last):"}, "traceback"),
        (
            {"message": "error: unexpected KeyError: 1. This is a bug, please report it"},
            "traceback",
        ),
        ({"message": ""}, "no message"),
        ({"seconds": 2.1}, "2.1 s, at most 2"),
        ({"megabytes": 201.0}, "201 MB, at most 200"),
        ({"written": ("s.mcap",)}, "wrote s.mcap"),
    ],
)
def test_whatever_goes_wrong_is_told(change: dict[str, object], said: str) -> None:
    assert objections(REFUSED, WELL) == []
    assert objections(REFUSED, replace(WELL, **change)) == [said]  # type: ignore[arg-type]


def test_a_message_about_something_else_is_told() -> None:
    assert objections(replace(REFUSED, says="duration_s"), WELL) == ["does not say 'duration_s'"]


def test_what_hangs_is_ended_and_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(trying, "PATIENCE", 0.2)
    monkeypatch.setattr(trying, "COMMAND", ("sleep",))
    monkeypatch.setattr(trying, "_start_up", lambda _: 0.0)
    ended = attempt(BadInput("sleeps", ("1000",)), SCENARIO, b"")
    assert ended.status == -signal.SIGKILL
    assert objections(REFUSED, ended)[0] == "status -9, not 2"


def test_time_and_memory_are_those_of_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    busy = (
        "import time\nx = bytearray(150 << 20)\nwhile time.process_time() < 0.5: pass\nopen('new',"
        " 'w')"
    )
    monkeypatch.setattr(trying, "COMMAND", (sys.executable, "-c", busy))
    monkeypatch.setattr(trying, "_start_up", lambda _: 0.1)
    ended = attempt(REFUSED, SCENARIO, b"")
    assert (ended.status, ended.message, ended.written) == (0, "", ("new",))
    assert 0.4 <= ended.seconds < 5.0
    assert 150.0 < ended.megabytes < 200.0


def test_memory_is_not_that_of_who_tries(monkeypatch: pytest.MonkeyPatch) -> None:
    """Linux counts what a process had before it became another program."""
    monkeypatch.setattr(trying, "COMMAND", (sys.executable, "-c", ""))
    monkeypatch.setattr(trying, "_start_up", lambda _: 0.0)
    mine = bytearray(os.urandom(1 << 20) * 300)
    assert attempt(REFUSED, SCENARIO, b"").megabytes < len(mine) / 2**20 / 2.0


def table(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], ended: Ended, *words: str
) -> tuple[int, str]:
    """The tool's exit status and what it prints when everything ends like that."""
    monkeypatch.setattr(trying, "attempt", lambda *_: ended)
    monkeypatch.setattr(trying, "good_log", lambda _: b"radius_m")
    monkeypatch.setattr(sys, "argv", ["bad_inputs", *words])
    monkeypatch.setattr(sys, "path", [*sys.path])
    status: int = runpy.run_path(str(TOOL))["main"]()
    return status, capsys.readouterr().out


def test_the_table(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    said = replace(WELL, message="error: key\x1b[2J: wrong\nmore")
    status, out = table(monkeypatch, capsys, said, "overrides")
    head, *rows, last = out.splitlines()
    assert head.split() == [
        "kind",
        "handed",
        "in",
        "ex.",
        "s",
        "MB",
        "first",
        "line",
        "of",
        "the",
        "message",
    ]
    assert len(rows) == len(bad_files.OVERRIDES)
    assert all(
        row.startswith("overrides  --set ")
        and row.endswith(r"  2   0.10     60  key\x1b[2J: wrong")
        for row in rows
    )
    assert (status, last) == (
        0,
        f"{len(rows)} inputs; exit status {len(rows)} x 2; at most 0.10 s, 60 MB; wrong: 0",
    )


def test_the_table_of_what_went_wrong(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    status, out = table(monkeypatch, capsys, replace(WELL, status=1, megabytes=300.0), "platforms")
    count = len(bad_files.PLATFORMS)
    assert status == 1
    assert out.count("^ status 1, not 2") == out.count("^ 300 MB, at most 200") == count
    assert out.splitlines()[-1].startswith(f"{count} inputs; exit status {count} x 1;")


def test_what_cannot_be_tried_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(trying, "_can_mount", lambda: False)
    _, out = table(monkeypatch, capsys, WELL, "disks", "overrides")
    assert out.count("left out: needs leave to mount a tmpfs") == len(bad_outputs.DISKS) > 0


def test_an_unknown_kind_is_refused_by_name(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit, match="2"):
        table(monkeypatch, capsys, WELL, "toaster")
    assert "invalid choice: 'toaster'" in capsys.readouterr().err
