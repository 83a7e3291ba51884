"""Standard streams that take nothing, and texts that no terminal may take for a command."""

import io
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from review.test_report import own_part

from atlas_cueing.cli import main
from atlas_cueing.cli.progress import shown_progress
from atlas_cueing.cli.streams import SafeStream, safe_streams
from atlas_cueing.errors import PrintError
from atlas_cueing.live.output import ring_recorder
from atlas_cueing.recording import McapRecorder, read_log
from atlas_cueing.run import prepare
from atlas_cueing.scenario import load_scenario, recorded_vehicle

from .conftest import Command
from .test_progress import Terminal

START = [sys.executable, "-m", "atlas_cueing"]
EVIL = "x\x1b]0;owned\x07\x1b[31m\r\nverdict  clean\u202e\u2066\u200b\u2028\x9b\x7f[red]<b>"
HOSTILE = "\x1b\x07\r\n\t\x08\x7f\x9b\u202e\u2066\u200f\u200b\u2028\udce9\udcff[]=./a"
WORDS = st.text(
    st.one_of(st.sampled_from(HOSTILE), st.characters(exclude_categories=())), min_size=1
)
FULL = Path("/dev/full")
needs_full = pytest.mark.skipif(not FULL.exists(), reason="needs /dev/full")


def is_safe(text: str) -> bool:
    return text.replace("\n", "").replace("\t", "").isprintable()


@pytest.fixture(params=["", "1"], ids=["buffered", "unbuffered"])
def environment(request: pytest.FixtureRequest) -> dict[str, str]:
    return {**os.environ, "PYTHONUNBUFFERED": request.param}


COMMANDS = [
    ["platform", "atlas-2.9m"],
    ["--help"],
    ["run", "--help"],
    ["platform", "atlas-2.9m", "--json"],
]
NO_SPACE = "error: standard output: No space left on device\n"


@needs_full
@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_results_onto_a_full_disk(words: Sequence[str], environment: dict[str, str]) -> None:
    with FULL.open("w") as full:
        ended = subprocess.run(
            [*START, *words], stdout=full, stderr=subprocess.PIPE, text=True, env=environment
        )
    assert (ended.returncode, ended.stderr) == (1, NO_SPACE)


@needs_full
def test_a_log_is_kept_though_its_figures_cannot_be_printed(
    command: Command, tmp_path: Path
) -> None:
    with FULL.open("w") as full:
        ended = subprocess.run(
            [*START, "run", "s.toml"], cwd=tmp_path, stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert (ended.returncode, ended.stderr) == (1, NO_SPACE)
    assert command("review", "short.mcap").status == 0


@needs_full
@pytest.mark.parametrize(
    ("words", "status"), [(["platform", "atlas-2.9m"], 0), (["platform", "x"], 2), (["nix"], 2)]
)
def test_messages_onto_a_full_disk(
    words: Sequence[str], status: int, environment: dict[str, str]
) -> None:
    with FULL.open("w") as full:
        ended = subprocess.run(
            [*START, *words], stdout=subprocess.DEVNULL, stderr=full, env=environment
        )
    assert ended.returncode == status


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_a_reader_that_is_gone_is_told_nothing(
    words: Sequence[str], environment: dict[str, str]
) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    ended = subprocess.run(
        [*START, *words], stdout=writing, stderr=subprocess.PIPE, text=True, env=environment
    )
    os.close(writing)
    assert (ended.returncode, ended.stderr) == (1, "")


def test_closed_streams() -> None:
    ends = []
    for closing in (">&-", "2>&-", "<&- >&- 2>&-"):
        script = f'"$@" {closing}'
        ended = subprocess.run(
            ["sh", "-c", script, "sh", *START, "platform", "atlas-2.9m"],
            capture_output=True,
            text=True,
        )
        ends.append((ended.returncode, bool(ended.stdout), ended.stderr))
    told = "error: standard output: Bad file descriptor\n"
    assert ends == [(1, False, told), (0, True, ""), (1, False, "")]


def test_what_is_opened_does_not_become_a_standard_stream(tmp_path: Path) -> None:
    """Or a library would print into the log."""
    program = (
        "import os; from atlas_cueing.cli.streams import safe_streams\n"
        "with safe_streams(), open('log', 'w'):\n os.write(1, b'x')\n os.write(2, b'x')"
    )
    script = '"$@" <&- >&- 2>&-'
    ended = subprocess.run(["sh", "-c", script, "sh", sys.executable, "-c", program], cwd=tmp_path)
    assert ended.returncode == 0
    assert (tmp_path / "log").read_bytes() == b""


@given(WORDS, st.sampled_from(["utf-8", "ascii", "latin-1", "utf-16"]))
def test_a_stream_lets_through_what_is_visible(text: str, encoding: str) -> None:
    behind = io.TextIOWrapper(io.BytesIO(), encoding=encoding, newline="\n")
    stream = SafeStream(behind, "standard output", must=True)
    assert stream.write(text) == len(text)
    stream.flush()
    behind.seek(0)
    assert is_safe(behind.read())


def test_a_stream_takes_texts_only() -> None:
    with pytest.raises(TypeError):
        SafeStream(io.StringIO(), "standard output", must=True).write(b"bytes")  # type: ignore[arg-type]
    assert not hasattr(SafeStream(io.StringIO(), "standard output", must=True), "buffer")


def test_no_stream_at_all() -> None:
    with pytest.raises(PrintError, match="standard output: Bad file descriptor"):
        SafeStream(None, "standard output", must=True).write("x")
    SafeStream(None, "standard error", must=False).write("x")


@settings(max_examples=60)
@given(
    WORDS.filter(lambda word: "\0" not in word),
    st.sampled_from(["file", "extra", "option", "key", "value", "command"]),
)
def test_no_word_of_the_command_line_commands_the_terminal(word: str, role: str) -> None:
    words = {
        "file": ["review", f"./{word}"],
        "extra": ["platform", "atlas-2.9m", word],
        "option": ["run", f"--{word}"],
        "key": ["run", "s.toml", "--set", f"{word}=1"],
        "value": ["platform", word],
        "command": [word],
    }[role]
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        status = main(words)
    assert status in (0, 1, 2)
    assert "This is a bug" not in err.getvalue()
    assert is_safe(out.getvalue())
    assert is_safe(err.getvalue())


@pytest.fixture
def evil(command: Command, tmp_path: Path) -> Path:
    """A log whose every text is hostile."""
    assert command("run", "s.toml").status == 0
    log = read_log(tmp_path / "short.mcap")
    vehicle, pipeline = prepare(load_scenario(tmp_path / "s.toml"), recorded_vehicle(log))
    metadata = dict.fromkeys(("scenario", "method", "platform"), EVIL)
    new = tmp_path / "evil.mcap"
    recorder = McapRecorder(
        new, head_S=(0.0, 0.0, 0.0), metadata=metadata, attachments=log.attachments
    )
    recorder.append(pipeline.step(vehicle.state))
    while vehicle.advance():
        recorder.append(pipeline.step(vehicle.state))
    recorder.status(0.0, EVIL, EVIL)
    recorder.close(EVIL, EVIL)
    return new


def test_a_hostile_log_commands_nothing(command: Command, evil: Path, tmp_path: Path) -> None:
    for words in (
        ["review", "evil.mcap", "--html", "a.html"],
        ["review", "evil.mcap", "--replay", "b.html"],
        ["compare", "evil.mcap", "short.mcap", "--html", "c.html"],
        ["recover", "evil.mcap", "-o", "r.mcap"],
        ["recue", "evil.mcap", "-o", "q.mcap"],
    ):
        ended = command(*words)
        assert "This is a bug" not in ended.err
        assert is_safe(ended.out)
        assert is_safe(ended.err)
        assert not any(
            line.startswith("verdict  clean") for line in f"{ended.out}\n{ended.err}".split("\n")
        )
    for page in ("a.html", "c.html"):
        own = own_part((tmp_path / page).read_text())
        assert "\\x1b]0;owned" in own
        assert is_safe(own)
        assert "[red]<b>" not in own
    told = json.loads(command("review", "evil.mcap", "--json").out)
    assert told["metadata"]["scenario"] == told["reason"] == EVIL
    assert evil.exists()


def test_the_states_of_a_live_run_command_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    reading, writing = os.pipe()
    monkeypatch.setattr(ring_recorder, "_STDERR", writing)
    ring_recorder.report_on_stderr(EVIL)
    os.close(writing)
    with os.fdopen(reading) as said:
        (line,) = said.read().splitlines()
    assert is_safe(line)


def test_a_bar_draws_and_its_name_does_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.setattr("atlas_cueing.cli.progress._SHORT", -1.0)
    stderr = Terminal()
    monkeypatch.setattr(sys, "stderr", stderr)
    with safe_streams(), shown_progress("[red]\x1b]0;owned\x07", 10.0) as tell:
        assert tell
        tell(1.0)
    assert "\x1b[" in stderr.getvalue()
    assert "[red]\\x1b]0;owned\\x07" in stderr.getvalue()
    assert "\x1b]" not in stderr.getvalue()
