"""A compiled wheel computes the same bits; one that cannot be compiled is Python and says why."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from building import PROJECT, build, build_wheel, version_of
from installed import needs_source_tree

from atlas_cueing.cueing import CAUSAL_METHODS

sys.path.append(str(PROJECT / "tools"))
import build_compiled

pytestmark = needs_source_tree
PROBE = Path(__file__).with_name("compiled_probe.py")
# what replaces parts, breaks them or hands in what is none
QUICK = ("live/control", "live/test_loop.py", "live/test_faults.py", "smoothing/test_axis.py")
QUICK += ("cueing/stage", "cueing/committee", "cueing/own")
PYTEST = (f"--rootdir={PROJECT}", "-p", "no:cacheprovider", "-p", "no:xdist", "-rfE", "--tb=short")
OBSTACLE = build_compiled.obstacle()
needs_a_compiler = pytest.mark.skipif(bool(OBSTACLE), reason=OBSTACLE)


def probe(folder: Path, build: Path | None) -> dict[str, str]:
    """What the build computes; None for the source under test."""
    folder.mkdir()
    environment = {**os.environ, **({"PYTHONPATH": str(build)} if build else {})}
    done = subprocess.run(
        [sys.executable, str(PROBE), str(folder)],
        env=environment,
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr[-3000:]
    found: dict[str, str] = json.loads(done.stdout)
    return found


def compiled_in(unpacked: Path) -> set[str]:
    """The modules of an unpacked wheel that are compiled, as paths of their sources."""
    found = (path.relative_to(unpacked) for path in (unpacked / "atlas_cueing").rglob("*.so"))
    return {str(path.with_name(path.name.split(".")[0] + ".py")) for path in found}


def passed(folder: Path, build: Path) -> int:
    """How many of the quick tests pass with the build; none may fail."""
    folder.mkdir()
    places = [str(PROJECT / "tests" / name) for name in QUICK]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-c", str(PROJECT / "pyproject.toml"), *PYTEST, *places],
        env={**os.environ, "PYTHONPATH": str(build)},
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stdout[-5000:] + done.stderr[-1000:]
    found = re.search(r"(\d+) passed", done.stdout)
    return int(found[1]) if found else 0


@needs_a_compiler
def test_compiled_code_computes_the_same_bits_and_passes_the_tests(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Some quick ones of the tests; `tools/build_wheels --test` runs all."""
    monkeypatch.chdir(PROJECT)
    unpacked, _ = build_wheel(tmp_path / "wheel")
    assert compiled_in(unpacked) == set(build_compiled.compiled_modules())
    assert version_of(unpacked).endswith(", compiled")
    compiled, source = probe(tmp_path / "compiled", unpacked), probe(tmp_path / "plain", None)
    assert (compiled.pop("code"), source.pop("code")) == (".so", ".py")
    assert compiled == source
    assert len(source) == len(CAUSAL_METHODS) + 4
    assert passed(tmp_path / "tested", unpacked) > 1000


def test_what_runs_every_tick_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(PROJECT)
    modules = {Path(path).stem for path in build_compiled.compiled_modules()}
    assert {
        "rotation",
        "pipeline",
        "states",
        "blend",
        "sphere",
        "drive",
        "guard",
        "tick_loads",
    } <= modules
    assert {"observer", "canals", "committee", "member", "weights", "draw", "loss"} <= modules
    assert {"loop", "setpoint", "setpoint_sender", "ring", "messages", "timing"} <= modules
    assert not {"__init__", "clock", "recorder", "plots"} & modules


@needs_a_compiler
def test_a_compiler_that_dies_half_way_leaves_nothing_behind(tmp_path: Path) -> None:
    """It translates a few files, and then no more: none of them is in the wheel."""
    calls, compiler = tmp_path / "calls", tmp_path / "cc"
    dies = f'#!/bin/sh\necho >>{calls}\n[ $(wc -l <{calls}) -le 9 ] && exec cc -O0 "$@"\nexit 1\n'
    compiler.write_text(dies)
    compiler.chmod(0o755)
    unpacked, told = build_wheel(tmp_path / "wheel", CC=str(compiler))
    assert len(calls.read_text()) > 9
    assert not [*unpacked.rglob("*.so")]
    assert re.search(f"compiling failed: [Cc]ommand '{compiler}' [^-]*(failed|non-zero)", told)
    assert "plain Python (compiling failed: " in version_of(unpacked)


@pytest.mark.parametrize(
    ("broken", "settings", "why"),
    [
        ("", {"ATLAS_CUEING_COMPILE": "0"}, "ATLAS_CUEING_COMPILE=0"),
        ("", {"CC": "no_such_compiler -O1"}, "no C compiler (no_such_compiler not found)"),
        ("raise OSError('not here')", {"CC": "true"}, "compiling failed: OSError: not here"),
        ("raise SystemExit(1)", {"CC": "true"}, "compiling failed: SystemExit: 1"),
    ],
)
def test_what_cannot_be_compiled_is_plain_python(
    tmp_path: Path,
    broken: str,
    settings: dict[str, str],
    why: str,
) -> None:
    (tmp_path / "mypyc").mkdir()
    (tmp_path / "mypyc" / "__init__.py").write_text(broken)
    unpacked, told = build_wheel(tmp_path / "wheel", before=tmp_path, **settings)
    assert compiled_in(unpacked) == set()
    assert version_of(unpacked).endswith(f", plain Python ({why})")
    assert f"atlas_cueing: not compiled: {why}" in told


def test_who_insists_on_compiling_is_told_that_it_failed(tmp_path: Path) -> None:
    (tmp_path / "mypyc").mkdir()
    (tmp_path / "mypyc" / "__init__.py").write_text("raise ImportError('no mypyc here')")
    done = build("wheel", tmp_path / "wheel", before=tmp_path, ATLAS_CUEING_COMPILE="1")
    assert done.returncode != 0
    assert "no mypyc here" in done.stderr
    assert not [*(tmp_path / "wheel").iterdir()]


def test_without_the_headers_of_python_nothing_is_tried(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(build_compiled, "_header_folders", lambda: [str(tmp_path)])
    monkeypatch.setenv("CC", "true")
    assert build_compiled.obstacle().startswith("no Python headers (Python.h;")
    (tmp_path / "Python.h").touch()
    assert build_compiled.obstacle() == ""
