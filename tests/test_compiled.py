"""The compiled build: made as `pip install` makes it, and bit for bit the same as the source."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parent.parent
PROBE = Path(__file__).with_name("compiled_probe.py")
NEEDED = ("atlas_cueing", "tools", "pyproject.toml", "README.md")
pytestmark = pytest.mark.skipif(shutil.which(os.environ.get("CC", "cc")) is None, reason="needs a C compiler")


def install(folder: Path, compile_it: str) -> tuple[Path, str]:
    """Install a copy of the sources into a folder of their own; what pip said."""
    source, target = folder / "source", folder / f"installed-{compile_it}"
    if not source.exists():
        source.mkdir()
        for name in NEEDED:
            copy = shutil.copytree if (PROJECT / name).is_dir() else shutil.copy
            copy(PROJECT / name, source / name)
    pip = [sys.executable, "-m", "pip", "install", "--verbose", "--no-deps", "--disable-pip-version-check"]
    done = subprocess.run(
        [*pip, "--target", str(target), str(source)],
        env={**os.environ, "ATLAS_CUEING_COMPILE": compile_it},
        capture_output=True,
        text=True,
        timeout=900,
    )
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    return target, done.stdout + done.stderr


def probe(folder: Path, build: Path | None) -> dict[str, str]:
    """What the build computes; None for the source under test."""
    folder.mkdir()
    environment = {**os.environ, **({"PYTHONPATH": str(build)} if build else {})}
    done = subprocess.run(
        [sys.executable, str(PROBE), str(folder)], env=environment, cwd=folder, capture_output=True, text=True, timeout=600
    )
    assert done.returncode == 0, done.stderr[-3000:]
    found: dict[str, str] = json.loads(done.stdout)
    return found


def test_compiled_code_computes_the_same_bits(tmp_path: Path) -> None:
    target, _ = install(tmp_path, "1")
    compiled, source = probe(tmp_path / "compiled", target), probe(tmp_path / "plain", None)
    assert (compiled.pop("code"), source.pop("code")) == (".so", ".py")
    assert compiled == source
    assert len(source) == 6


def test_without_a_compiler_it_is_plain_python_and_says_so(tmp_path: Path) -> None:
    target, said = install(tmp_path, "0")
    assert not list(target.rglob("*.so"))
    assert "atlas_cueing: not compiled" in said
