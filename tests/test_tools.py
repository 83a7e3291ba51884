"""The tools as README writes them: called by name, from anywhere, by any interpreter."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import environment
import pytest

ROOT = Path(__file__).parents[1]
TOOLS = sorted(
    path
    for path in (ROOT / "tools").iterdir()
    if path.is_file() and path.read_bytes()[:40].find(b"python") > 0
)
# the interpreter without the packages of its environment
BARE = getattr(sys, "_base_executable", sys.executable)


def called(
    command: list[str | Path], folder: Path, **more: str
) -> subprocess.CompletedProcess[str]:
    setting = {"PATH": os.environ["PATH"], "HOME": str(folder), **more}
    return subprocess.run(
        command, cwd=folder, env=setting, capture_output=True, text=True, timeout=300, check=False
    )


def test_there_are_tools() -> None:
    assert {"results", "check_readme", "pictures", "send_flightgear"} <= {
        tool.name for tool in TOOLS
    }


@pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: tool.name)
def test_help_has_an_example_of_the_tool_itself(tool: Path, tmp_path: Path) -> None:
    told = called([sys.executable, tool, "--help"], tmp_path)
    assert (told.returncode, told.stderr) == (0, "")
    assert re.search(rf"^example:\n  tools/{tool.name}\b", told.stdout, re.MULTILINE)


@pytest.mark.parametrize("tool", TOOLS, ids=lambda tool: tool.name)
def test_wrong_arguments_are_told_in_a_line(tool: Path, tmp_path: Path) -> None:
    told = called([sys.executable, tool, "--nonsense"], tmp_path)
    assert (told.returncode, told.stdout) == (2, "")
    assert told.stderr.startswith(f"tools/{tool.name}: ")
    assert told.stderr.count("\n") == 1


@pytest.mark.parametrize("name", ["results", "stage_ratio", "preview_gap", "washout_angles"])
@pytest.mark.parametrize("scenario", ["no_such_scenario", "bad.toml", "empty_folder"])
def test_a_scenario_that_cannot_be_flown_is_told_in_a_line(
    name: str, scenario: str, tmp_path: Path
) -> None:
    (tmp_path / "bad.toml").write_text("name = 3\n")
    (tmp_path / "empty_folder").mkdir()
    told = called([sys.executable, ROOT / "tools" / name, scenario], tmp_path)
    assert (told.returncode, told.stdout) == (2, "")
    assert scenario in told.stderr
    assert told.stderr.count("\n") == 1


def test_no_tool_changes_the_build_that_is_there() -> None:
    """`tools/setup dev` makes an editable install, which is Python: no tool may ask for it."""
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = extras["optional-dependencies"]
    asked = {
        name
        for tool in TOOLS
        for name in re.findall(r'^enter\("(.*)"\)', tool.read_text(), re.MULTILINE)
    }
    assert "tools" in asked
    assert asked <= set(extras) - {"dev"}
    assert {wanted for name in asked for wanted in extras[name]} <= set(extras["dev"])


def copied(folder: Path, setup: str) -> Path:
    """A project with a tool that prints its interpreter, and a setup that does as the test says."""
    tools = folder / "tools"
    tools.mkdir()
    shutil.copy(ROOT / "tools" / "environment.py", tools)
    (tools / "setup").write_text(f"#!/bin/sh\n{setup}\n")
    (tools / "setup").chmod(0o755)
    tool = tools / "where"
    tool.write_text(
        'import sys\nfrom environment import enter\n\nenter("live")\nprint(sys.executable,'
        " *sys.argv[1:])\n"
    )
    return tool


def test_a_tool_sets_the_environment_up_and_starts_again_in_it(tmp_path: Path) -> None:
    python = tmp_path / ".venv" / "bin" / "python"
    tool = copied(tmp_path, f"echo set up: $* >&2\n{BARE} -m venv --without-pip {tmp_path}/.venv")
    told = called([BARE, tool, "a b", "c"], tmp_path)
    assert (told.stdout, told.stderr) == (f"{python} a b c\n", "set up: live\nset up: live\n")


def test_a_tool_ends_as_its_setup_does(tmp_path: Path) -> None:
    told = called([BARE, copied(tmp_path, "echo no >&2; exit 2")], tmp_path)
    assert (told.returncode, told.stdout, told.stderr) == (2, "", "no\n")


def test_a_tool_stays_in_an_interpreter_that_has_all_it_needs(tmp_path: Path) -> None:
    told = called([sys.executable, copied(tmp_path, "exit 2")], tmp_path)
    assert told.stdout == f"{sys.executable}\n"


@pytest.mark.parametrize(("extra", "lacking"), [("", False), ("dev", False), ("preview", True)])
def test_what_is_lacking_is_what_the_extra_asks_for(
    extra: str, lacking: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    def requires(_: str) -> list[str]:
        return ["numpy>=2.0", 'pytest>=8; extra == "dev"', "no-such-package>=1; extra == 'preview'"]

    monkeypatch.setattr(environment.metadata, "requires", requires)
    assert environment._lacking(extra) is lacking


def test_a_dependency_that_is_missing_is_lacking_for_every_tool(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(
        environment.metadata, "requires", lambda _: ["no-such-package>=1; python_version > '3'"]
    )
    assert environment._lacking("")


def test_an_interrupt_leaves_no_traceback(tmp_path: Path) -> None:
    tool = copied(tmp_path, "exit 2")
    for error, shown in (
        ("KeyboardInterrupt", ""),
        ("BrokenPipeError", ""),
        ("ValueError('x')", "Traceback"),
    ):
        tool.write_text(f"from environment import enter\n\nenter()\nraise {error}\n")
        told = called([sys.executable, tool], tmp_path)
        assert told.returncode != 0
        assert told.stderr[:9] == shown
