"""The sdist holds all that a build and the tests need and no junk; building leaves no traces."""

import shutil
from pathlib import Path

import pytest
from building import PROJECT, build_sdist, build_wheel, version_of
from installed import needs_source_tree

pytestmark = needs_source_tree

BELONGING = ("pyproject.toml", "README.md", ".gitignore", ".ci")
BELONGING += ("atlas_cueing", "scenarios", "tests", "tools")
ADDED = {"PKG-INFO", "setup.cfg"}  # by setuptools, beside the folder *.egg-info
JUNK = (
    "scenarios/__pycache__/x.pyc",
    "scenarios/flight.mcap",
    "tests/.pytest_cache/x",
    "atlas_cueing/rotation.cpython-311-x86_64-linux-gnu.so",
    ".venv/bin/python",
    "build/lib/atlas_cueing/gone.py",
    "notes.txt",
)


def files(folder: Path) -> set[str]:
    """Every file below `folder` but the bytecode of the build's own modules, which Python keeps."""
    bytecode = folder / "tools" / "__pycache__"
    return {
        str(path.relative_to(folder))
        for path in folder.rglob("*")
        if path.is_file() and path.parent != bytecode
    }


def _is_data(name: str) -> bool:
    """Whether a file of the package is read at run time, or by users: neither code nor README."""
    return name.startswith("atlas_cueing/") and not name.endswith((".py", ".md"))


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A source tree without git and without junk."""
    target = tmp_path_factory.mktemp("source") / "project"
    target.mkdir()
    junk = shutil.ignore_patterns("__pycache__", "*.mcap", "*.so", ".*_cache", ".hypothesis")
    for name in BELONGING:
        source = PROJECT / name
        if source.is_dir():
            shutil.copytree(source, target / name, ignore=junk)
        else:
            shutil.copy(source, target)
    return target


@pytest.fixture(scope="module")
def sdist(project: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The unpacked sdist of a source tree that is full of junk; the junk is gone afterwards."""
    belonging = files(project)
    for name in JUNK:
        (project / name).parent.mkdir(parents=True, exist_ok=True)
        (project / name).touch()
    top = build_sdist(tmp_path_factory.mktemp("sdist") / "built", project)
    assert files(project) == belonging.union(JUNK), "building leaves no traces"
    for name in JUNK:
        (project / name).unlink()
    return top


def test_the_sdist_is_the_source_tree(project: Path, sdist: Path) -> None:
    added = {name for name in files(sdist) if ".egg-info/" not in name} - files(project)
    assert files(project) - files(sdist) == set()
    assert added == ADDED
    assert {"tools/build_backend.py", "tests/conftest.py", ".gitignore"} <= files(sdist)
    assert (sdist / "tools" / "test").stat().st_mode & 0o100, "it can still be run"


def test_a_wheel_from_the_sdist_is_that_of_the_tree(
    project: Path,
    sdist: Path,
    tmp_path: Path,
) -> None:
    plain = {"ATLAS_CUEING_COMPILE": "0"}
    (project / "build/lib/atlas_cueing").mkdir(parents=True, exist_ok=True)
    (project / "build/lib/atlas_cueing" / "gone.py").touch()  # of a build before the module went
    first, _ = build_wheel(tmp_path / "first", project=project, **plain)
    second, _ = build_wheel(tmp_path / "second", project=sdist, **plain)
    assert files(first) == files(second)
    data = {name for name in files(project) if _is_data(name)}
    assert {
        "atlas_cueing/flight_data/maps/csv.toml",
        "atlas_cueing/py.typed",
        "atlas_cueing/scenario/presets/atlas-2.9m.toml",
        "atlas_cueing/vehicles/atlas_packet.h",
    } <= data
    assert data - files(first) == set(), "package data that a wheel lacks"
    assert "atlas_cueing/gone.py" not in files(first)
    assert "plain Python" in version_of(second)
