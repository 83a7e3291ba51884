"""Builds the package (PEP 517): setuptools, with the code that runs every tick compiled by mypyc.

The compiled modules are the same Python source and compute the same bits in a tenth to a half of
the time. A wheel, and so `pip install .`, is compiled where that works; where it does not, it is
plain Python, and `atlas-cueing --version` says why. An editable install stays plain Python, so
that a change of the source is a change of the program. ATLAS_CUEING_COMPILE=0 leaves the compiler
out, =1 insists on it: a failing compilation then fails the build.

Wheel and sdist are built in a copy of the files that belong to them. So nothing is left in the
source tree, which may be read-only, and nothing that lies about in it gets into them.
"""

import os
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import chdir, contextmanager
from functools import partial
from pathlib import Path
from shutil import copy, copytree, ignore_patterns
from tempfile import TemporaryDirectory
from typing import Any

import setuptools
from build_compiled import OBSTACLE, ParallelBuild, extensions, obstacle
from setuptools import build_meta
from setuptools.build_meta import (
    build_editable,
    get_requires_for_build_editable,
    prepare_metadata_for_build_editable,
)
from setuptools.command.sdist import sdist

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_editable",
    "prepare_metadata_for_build_wheel",
]

BELONGING: tuple[str, ...] = (".ci", ".gitignore", "README.md", "pyproject.toml")
BELONGING += ("atlas_cueing", "scenarios", "tests", "tools")
SETTING = "ATLAS_CUEING_COMPILE"
# mypy checks what it compiles, with types of numpy in it; a major version of either may refuse it
COMPILING = ["mypy>=1.18,<3", "numpy>=2.0,<3"]
Settings = Mapping[str, Any] | None


def get_requires_for_build_sdist(settings: Settings = None) -> list[str]:  # noqa: ARG001 - PEP 517
    """Name what has to be there to build an sdist, beside build-system.requires."""
    return []


def get_requires_for_build_wheel(settings: Settings = None) -> list[str]:  # noqa: ARG001 - PEP 517
    """Name what has to be there to build a wheel, beside build-system.requires."""
    return [] if _why_plain() else COMPILING


def prepare_metadata_for_build_wheel(folder: str, settings: Settings = None) -> str:
    """Write the wheel's metadata into `folder`; gives the name of their own folder in it."""
    folder = os.path.abspath(folder)
    with _staged():
        return build_meta.prepare_metadata_for_build_wheel(folder, settings)


def build_sdist(folder: str, settings: Settings = None) -> str:
    """Build an sdist with all that a build and the tests need; gives its file name."""
    folder = os.path.abspath(folder)
    with _staged(), _setup(cmdclass={"sdist": _WholeTree}):
        return build_meta.build_sdist(folder, settings)


def build_wheel(folder: str, settings: Settings = None, metadata: str | None = None) -> str:
    """Build a wheel into `folder`, compiled if that works; gives its file name."""
    why_plain = _why_plain()
    if not why_plain:
        try:
            return _build_wheel(folder, settings, metadata)
        except (Exception, SystemExit) as error:  # compiler, mypyc, setuptools have their own
            if _asked() == "1":
                raise
            why_plain = _in_few_words(error)
    print(f"atlas_cueing: not compiled: {why_plain}", file=sys.stderr)
    return _build_wheel(folder, settings, metadata, why_plain)


def _build_wheel(folder: str, settings: Settings, metadata: str | None, why: str = "") -> str:
    """Build a compiled wheel or, if there is a `why` not, a plain one that can tell it."""
    folder, metadata = os.path.abspath(folder), metadata and os.path.abspath(metadata)
    with _staged():
        if why:
            OBSTACLE.write_text(f"{why}\n", "utf-8")
            return build_meta.build_wheel(folder, settings, metadata)
        with _setup(ext_modules=extensions(), cmdclass={"build_ext": ParallelBuild}):
            return build_meta.build_wheel(folder, settings, metadata)


def _why_plain() -> str:
    """Tell what speaks against compiling before it is tried; nothing ("") for most."""
    if _asked() == "0":
        return f"{SETTING}=0"
    return "" if _asked() == "1" else obstacle()


def _asked() -> str:
    return os.environ.get(SETTING, "")


def _in_few_words(error: BaseException) -> str:
    """Tell of an error what fits on a line: of a command its name and not its arguments."""
    told = str(error) if str(error).startswith("error: ") else f"{type(error).__name__}: {error}"
    short = re.sub(r"\['([^']+)'.*\]", r"\1", told.splitlines()[0].removeprefix("error: "))
    return f"compiling failed: {short}"[:200]


@contextmanager
def _staged() -> Iterator[None]:
    """Work in a copy of the files that belong to the project."""
    with TemporaryDirectory(prefix="atlas_cueing_build_") as stage:
        for name in BELONGING:
            _stage(Path(name), Path(stage, name))
        with chdir(stage):
            yield


def _stage(source: Path, target: Path) -> None:
    """Copy a file or a folder, without what git does not keep."""
    if source.is_file():
        copy(source, target)
    elif source.is_dir():
        kept_out = Path(".gitignore").read_text("utf-8").replace("/\n", "\n").splitlines()
        copytree(source, target, ignore=ignore_patterns(*kept_out))
        for folder in (target, *(path for path in target.rglob("*") if path.is_dir())):
            folder.chmod(0o755)  # also where the source is read-only


@contextmanager
def _setup(**more: Any) -> Iterator[None]:
    """Let setuptools, which is told everything else by pyproject.toml, know of this as well."""
    plain = setuptools.setup
    setuptools.setup = partial(plain, **more)
    try:
        yield
    finally:
        setuptools.setup = plain


class _WholeTree(sdist):  # type: ignore[misc] # without types
    """An sdist of all that is staged, whatever setuptools takes for its sources."""

    def make_release_tree(self, base_dir: str, files: list[str]) -> None:
        staged = {str(path) for path in Path().rglob("*") if path.is_file()}
        super().make_release_tree(base_dir, sorted(staged.union(files)))
