"""The tool that tries README: what it reads there, and that it reports what ends badly."""

import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from typing import Any

import pytest
from installed import ROOT, needs_source_tree

loader = SourceFileLoader("check_readme", str(ROOT / "tools" / "check_readme"))
spec = spec_from_loader(loader.name, loader)
assert spec
tool: Any = module_from_spec(spec)
before, sys.dont_write_bytecode = sys.dont_write_bytecode, True
loader.exec_module(tool)
sys.dont_write_bytecode = before

README = """
Named: `tools/fuzz`, `tools/demo`, `tools/fuzz` again and files, tools/foxglove_layout.json,
tools/benchmarks/figures.json;
tools/check_readme is itself.

```sh
tools/demo --json      # a comment
a 'b # c' &   # beside
x --y
```

```text
not a command
```
```sh
z
```
"""


def test_all_lines_of_shell_blocks_and_all_tools_that_are_named() -> None:
    assert list(tool.lines(README)) == [
        tool.Line("tools/demo --json"),
        tool.Line("x --y", ("a 'b # c'",)),
        tool.Line("z"),
        tool.Line("tools/fuzz"),
    ]


@pytest.mark.parametrize(
    ("command", "run"),
    [
        ("tools/demo", "tools/demo"),
        ("tools/test", "tools/setup dev"),
        ("tools/check", "tools/check tests/signals"),
        ("tools/results", "tools/results rudder_kick"),
        ("tools/results_of_another_kind", "tools/results_of_another_kind"),
        (
            ".venv/bin/atlas-cueing live a.toml",
            ".venv/bin/atlas-cueing live a.toml --rate 100 --lead 80 --duration 8",
        ),
        (
            ".venv/bin/atlas-cueing live scenarios/live/flightgear.toml --duration 30",
            ".venv/bin/atlas-cueing live scenarios/live/flightgear.toml --duration 30 --rate 100"
            " --lead 80 --duration 10 --pose p.json --from home",
        ),
    ],
)
def test_long_commands_are_shortened_by_their_own_options(command: str, run: str) -> None:
    assert tool.shortened(command) == run


@needs_source_tree
def test_every_shortened_command_is_in_readme() -> None:
    found = [
        command for line in tool.lines(tool.texts(ROOT)) for command in (*line.beside, line.command)
    ]
    for begins in (*tool.SHORTER, *tool.INSTEAD):
        assert any(f"{command} ".startswith(f"{begins} ") for command in found), begins


@pytest.mark.parametrize(
    ("line", "well"),
    [
        (("true",), True),
        (("false",), False),
        (("true", ("exit 3",)), False),
        (("exit 3", ("true",)), False),
    ],
)
def test_a_line_ends_well_when_all_of_it_does(
    line: tuple[Any, ...], well: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert tool.Newcomer(tmp_path, tmp_path).tries(tool.Line(*line)) is well
    assert len(capsys.readouterr().out.splitlines()) >= len(line)


def test_a_newcomer_has_nothing_in_the_environment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SECRET", "x")
    check = f'[ -z "$SECRET" ] && [ "$HOME" = {tmp_path} ] && [ "$PWD" = {tmp_path} ]'
    assert tool.Newcomer(tmp_path, tmp_path).tries(tool.Line(check))


def test_a_live_command_is_tried_again_with_its_log_gone(tmp_path: Path) -> None:
    (tmp_path / "old.mcap").touch()
    live = (
        f": {tool.LIVE}; [ ! -e new.mcap ] && touch new.mcap && echo x >> tries && [ $(wc -l <"
        " tries) = 3 ]"
    )
    assert tool.Newcomer(tmp_path, tmp_path).tries(tool.Line(live))
    assert (tmp_path / "old.mcap").exists()


def test_what_takes_too_long_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tool, "LONGEST_S", 0.2)
    assert not tool.Newcomer(tmp_path, tmp_path).tries(tool.Line("cat /dev/zero > /dev/null"))


def test_what_is_installed_elsewhere_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    home = tmp_path / "home"
    (home / ".cache").mkdir(parents=True)
    monkeypatch.setattr(tool, "installed", lambda: {"old", "chromium", "libx", "/usr/local/bin/x"})
    assert tool.strange({"old"}, home) == ["/usr/local/bin/x"]
    assert tool.strange({"old", "chromium", "/usr/local/bin/x"}, home) == ["libx"]
    (home / ".local").mkdir()
    assert tool.strange(tool.installed(), home) == [str(home / ".local")]
