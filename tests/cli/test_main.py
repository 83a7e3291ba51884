"""What all commands have in common: usage, versions, errors without tracebacks."""

import logging
import os
import re
import signal
import subprocess
import sys
from importlib import import_module
from importlib.metadata import entry_points, version
from pathlib import Path

import pytest
from waiting import until

from atlas_cueing import rotation, run
from atlas_cueing.__main__ import main
from atlas_cueing.errors import InputError, LogError
from atlas_cueing.evaluation import DECLARED

from .conftest import SCRIPT, Command

START = [sys.executable, "-m", "atlas_cueing"]


def test_the_installed_command_is_this_one() -> None:
    (script,) = entry_points(group="console_scripts", name="atlas-cueing")
    assert script.load() is main


def test_an_interrupt_while_loading_is_no_traceback() -> None:
    """The signal comes with the first import of the command line's own modules.

    `live` in another test leaves Ctrl-C ignored, which a new process inherits.
    """
    code = (
        "import sys, os, signal\n"
        "class Interrupting:\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'typer': os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.meta_path.insert(0, Interrupting())\n"
        "from atlas_cueing.__main__ import main\n"
        "sys.exit(main())"
    )
    ended = subprocess.run(
        [
            sys.executable,
            "-c",
            "import signal; signal.signal(2, signal.default_int_handler)\n" + code,
        ],
        capture_output=True,
        check=False,
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, b"", b"")


def test_nothing_is_collected_at_the_exit() -> None:
    """That would take longer than all else between the end of a command and its process's."""
    code = (
        "import atexit, gc, sys\n"
        "atexit.register(lambda: print(gc.get_freeze_count() > 10_000))\n"
        "from atlas_cueing.__main__ import main\n"
        "sys.exit(main())"
    )
    command = [sys.executable, "-c", code, "--version"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert said.splitlines()[1:] == ["True"]


def test_version(command: Command) -> None:
    kind = (
        "compiled"
        if rotation.__file__.endswith(".so")
        else "plain Python (it runs from its source tree)"
    )
    ended = command("--version")
    assert (ended.status, ended.out, ended.err) == (
        0,
        f"atlas-cueing {version('atlas_cueing')}, {kind}\n",
        "",
    )


@pytest.mark.parametrize("arguments", [["--help"], ["run", "--help"], ["platform", "--help"]])
def test_help_has_examples(command: Command, arguments: list[str]) -> None:
    ended = command(*arguments)
    assert (ended.status, ended.err) == (0, "")
    assert "Example" in ended.out
    assert "atlas-cueing " + (arguments[0] if len(arguments) > 1 else "run") in ended.out


@pytest.mark.parametrize("word", ["batch", "design", "live", "recue", "run"])
def test_examples_can_be_copied_from_the_help(command: Command, word: str) -> None:
    epilog = import_module(f"atlas_cueing.cli.{word}").EPILOG
    examples = re.findall(r"^  (atlas-cueing .*)$", epilog, re.MULTILINE)
    shown = command(word, "--help").out
    assert max(map(len, shown.splitlines())) <= 80
    lines = re.sub(r"\s*\\\n\s*", " ", shown).splitlines()
    assert {" ".join(each.split()) for each in examples} <= {each.strip() for each in lines}


@pytest.mark.parametrize("word", ["run", "review", "compare"])
def test_help_says_what_figures_mean(command: Command, word: str) -> None:
    told = " ".join(command(word, "--help").out.split())
    for metric in (metric for metric in DECLARED.values() if metric.meaning):
        first, *rest = metric.title.removesuffix(" rms").split()
        assert first in told, metric.name
        assert " ".join(rest).replace("10s", "10 s") in told, metric.name


def test_help_loads_neither_simulator_nor_numbers() -> None:
    """That is what makes it fast."""
    code = (
        "import sys; from atlas_cueing.cli import main; main(['run', '--help']);"
        " print(*sorted(sys.modules), file=sys.stderr)"
    )
    modules = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stderr.split()
    assert "atlas_cueing.cli.run" in modules
    assert "atlas_cueing.cli.batch" not in modules  # nor the other commands
    assert not {"jsbsim", "numpy", "scipy", "ruckig", "mcap"} & set(modules)


@pytest.mark.parametrize(
    "arguments",
    [["fly"], ["run"], ["run", "a.toml", "b.toml"], ["run", "s.toml", "--fast"], ["--json"]],
)
def test_wrong_usage(command: Command, tmp_path: Path, arguments: list[str]) -> None:
    ended = command(*arguments)
    assert (ended.status, ended.out) == (2, "")
    assert "Usage: atlas-cueing" in ended.err
    assert [path.name for path in tmp_path.iterdir()] == ["s.toml"]


def test_no_arguments_show_the_help(command: Command) -> None:
    ended = command()
    assert ended.status == 2
    assert "Commands:" in ended.out + ended.err


@pytest.mark.parametrize(("error", "status"), [(InputError("wrong"), 2), (LogError("wrong"), 1)])
def test_errors_of_ours(
    command: Command, monkeypatch: pytest.MonkeyPatch, error: Exception, status: int
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(run, "check_output", fail)
    ended = command("run", "s.toml")
    assert (ended.status, ended.out, ended.err) == (status, "", "error: wrong\n")


def test_errors_that_nobody_expected(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError("oops")

    monkeypatch.setattr(run, "check_output", fail)
    ended = command("run", "s.toml")
    assert (ended.status, ended.out) == (1, "")
    assert ended.err.count("\n") == 1
    assert ended.err.startswith("error: unexpected ZeroDivisionError: oops. This is a bug")
    ended = command("--debug", "run", "s.toml")
    assert ended.status == 1
    assert "Traceback" in ended.err


def test_debug_shows_the_log(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(SCRIPT)
    ended = subprocess.run(
        [*START, "--debug", "run", "s.toml", "--json"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert "atlas_cueing.jsbsim" in ended.stderr
    assert ended.stdout.startswith("{")


def test_main_adds_no_output_of_its_own_to_the_log(command: Command) -> None:
    command("--version")
    handlers = logging.getLogger("atlas_cueing").handlers
    assert [type(handler) for handler in handlers] == [logging.NullHandler]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_a_run_with_a_finished_log(tmp_path: Path, number: signal.Signals) -> None:
    (tmp_path / "s.toml").write_text(SCRIPT.replace("0.45", "3600.0").replace("c1722", "ball"))
    process = subprocess.Popen(
        [*START, "run", "s.toml", "--json"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    part = tmp_path / "short.mcap.part"
    until(lambda: part.exists() and part.stat().st_size > 100_000, 60.0)
    os.kill(process.pid, number)
    out, err = process.communicate(timeout=60.0)
    assert process.returncode == 1
    assert '"result": "interrupted"' in out
    assert err.startswith("interrupted: asked to stop at ")
    assert (tmp_path / "short.mcap").exists()
    assert not part.exists()
