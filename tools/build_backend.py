"""Builds the package, with the code that runs every tick compiled by mypyc (https://mypyc.readthedocs.io).

The compiled modules are the same Python source and compute the same bits, in a tenth to a half of the time. A wheel, and so
`pip install .`, is compiled where there is a C compiler, and says so when there is none. An editable install stays Python, so
that a change of the source is a change of the program. ATLAS_CUEING_COMPILE=0 leaves the compiler out, =1 insists on it.
"""

import os
import sys
import sysconfig
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from shutil import which
from typing import Any

import setuptools
from setuptools import build_meta
from setuptools.build_meta import (
    build_editable,
    build_sdist,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
    prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel,
)

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

PACKAGE = Path("atlas_cueing")
EVERY_TICK = (
    "rotation.py",
    "batch/run.py",
    "pipeline.py",
    "signals/states.py",
    "signals/topics.py",
    "vehicles/bounds.py",
    "vehicles/inputs.py",
    "vehicles/jsbsim_vehicle.py",
    "vehicles/readings.py",
    "cueing/*.py",
    "smoothing/*.py",
    "wheels/drive.py",
    *(f"live/{name}.py" for name in ("conductor", "course", "following", "guard", "interpolation", "ride", "source")),
    *(f"live/{name}.py" for name in ("supervisor", "vehicle_source")),
)
NOT = ("__init__.py",)  # names only
SETTING = "ATLAS_CUEING_COMPILE"
Settings = Mapping[str, Any] | None


def get_requires_for_build_wheel(settings: Settings = None) -> list[str]:
    """What has to be there to build a wheel."""
    return [*build_meta.get_requires_for_build_wheel(settings), *(["mypy>=1.18"] if compiles() else [])]


def build_wheel(folder: str, settings: Settings = None, metadata: str | None = None) -> str:
    """Build a wheel into `folder`; its file name."""
    if not compiles():
        print(f"atlas_cueing: not compiled (no C compiler, or {SETTING}=0); it runs at a third of the speed", file=sys.stderr)
        return build_meta.build_wheel(folder, settings, metadata)
    with extensions(compiled()):
        return build_meta.build_wheel(folder, settings, metadata)


def compiles() -> bool:
    """Whether to compile."""
    compiler = (os.environ.get("CC") or sysconfig.get_config_var("CC") or "cc").split()[0]
    return os.environ.get(SETTING, "1" if which(compiler) else "0") != "0"


def compiled() -> list[setuptools.Extension]:
    """The compiled modules as extensions of C."""
    from mypyc.build import mypycify

    files = sorted(str(path) for pattern in EVERY_TICK for path in PACKAGE.glob(pattern) if path.name not in NOT)
    # types are checked elsewhere, with everything installed; here nothing is
    found = mypycify(["--config-file=", "--ignore-missing-imports", *files], opt_level="3", debug_level="0")
    for extension in found:
        extension.extra_compile_args = [*extension.extra_compile_args, "-ffp-contract=off"]  # fused operations are other bits
    return found


@contextmanager
def extensions(modules: list[setuptools.Extension]) -> Iterator[None]:
    """Let setuptools, which is told everything else by pyproject.toml, build these as well."""
    plain = setuptools.setup
    setuptools.setup = partial(plain, ext_modules=modules)
    try:
        yield
    finally:
        setuptools.setup = plain
