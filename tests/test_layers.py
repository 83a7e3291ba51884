"""Imports go down only, and the top level of the repository shows what it is for."""

import ast
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from installed import PACKAGE, ROOT, needs_source_tree

TOP = {"README.md", "atlas_cueing", "pyproject.toml", "scenarios", "tests", "tools"}
SDIST = {"PKG-INFO", "setup.cfg"}  # added by setuptools to an sdist
LINT = [
    sys.executable,
    "-c",
    "from importlinter.cli import lint_imports_command; lint_imports_command()",
    "--no-cache",
]


def lint(folder: Path) -> subprocess.CompletedProcess[str]:
    """The contracts of pyproject.toml, in a process of its own.

    It imports what is in the folder, not what is installed.
    """
    return subprocess.run(
        LINT, cwd=folder, capture_output=True, text=True, timeout=300, check=False
    )


def test_the_contracts_are_kept() -> None:
    told = lint(ROOT)
    assert told.returncode == 0, told.stdout + told.stderr
    assert "imports go down only KEPT" in told.stdout
    assert "0 broken" in told.stdout


@pytest.mark.parametrize(
    ("file", "line", "contract"),
    [
        (
            "rotation.py",
            "from .errors import AtlasError\nfrom .signals import Cue",
            "imports go down only",
        ),
        ("cueing/damping.py", "from ..smoothing import Stop", "imports go down only"),
        ("cueing/damping.py", "import ruckig", "only smoothing knows ruckig"),
        ("smoothing/stop.py", "import jsbsim", "only vehicles knows JSBSim"),
        ("wheels/drive.py", "import mcap", "only recording knows MCAP"),
        ("utils.py", "", "imports go down only"),
    ],
)
def test_a_breach_is_seen(tmp_path: Path, file: str, line: str, contract: str) -> None:
    """The contracts can fail: a forbidden line or a noun without a layer, in a copy of the code."""
    shutil.copytree(
        PACKAGE, tmp_path / "atlas_cueing", ignore=shutil.ignore_patterns("__pycache__", "*.so")
    )
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    breached = tmp_path / "atlas_cueing" / file
    breached.write_text((breached.read_text() if breached.exists() else "") + f"\n{line}\n")
    told = lint(tmp_path)
    assert told.returncode != 0, told.stdout + told.stderr
    assert contract in told.stdout + told.stderr


def tracked() -> set[str]:
    """First part of the path of every tracked file.

    Of every file there is, where there is no git.
    """
    if shutil.which("git") and (ROOT / ".git").exists():
        listed = subprocess.run(
            ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, timeout=60, check=True
        )
        return {line.split("/")[0] for line in listed.stdout.splitlines()}
    found = {
        path.name for path in ROOT.iterdir() if not path.name.endswith((".egg-info", "__pycache__"))
    }
    return found - SDIST


@needs_source_tree
def test_the_top_level_holds_nothing_else() -> None:
    found = {name for name in tracked() if not name.startswith(".")}
    assert found - TOP == set()
    assert {"atlas_cueing", "pyproject.toml", "tests"} <= found


def public_functions(file: Path) -> Iterator[str]:
    """Names of the functions of a module that may be imported from it."""
    for node in ast.parse(file.read_text("utf-8")).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield node.name


def test_no_public_function_has_the_name_of_a_package_beside_it() -> None:
    """Imported into the package above, it would hide that package."""
    hidden = [
        f"{file.relative_to(PACKAGE)}: {name}"
        for file in PACKAGE.rglob("*.py")
        for name in public_functions(file)
        for folder in (file.parent, *file.parents)
        if folder.is_relative_to(PACKAGE) and (folder / name / "__init__.py").exists()
    ]
    assert not hidden
