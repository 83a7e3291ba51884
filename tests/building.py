"""Wheels and sdists of this project, made by its build backend in a process of its own."""

import os
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path
from typing import Any

PROJECT = Path(__file__).resolve().parent.parent
_BUILD = """
import sys
sys.path[:0] = [{tools!r}, *{before!r}]
import build_backend
print("built:", build_backend.build_{kind}({folder!r}))
"""


def build(
    kind: str,
    folder: Path,
    *,
    project: Path = PROJECT,
    before: Path | None = None,
    **settings: str,
) -> subprocess.CompletedProcess[str]:
    """Build a `wheel` or `sdist` into a new folder as pip would ask for it.

    before: a folder whose modules come before all others. settings: environment variables.
    """
    folder.mkdir()
    first = [str(before)] if before else []
    code = _BUILD.format(tools=str(project / "tools"), before=first, kind=kind, folder=str(folder))
    unset = ("ATLAS_CUEING_COMPILE", "CC")
    environment = {name: value for name, value in os.environ.items() if name not in unset}
    return subprocess.run(
        [sys.executable, "-c", code],
        cwd=project,
        env={**environment, **settings},
        capture_output=True,
        text=True,
        timeout=900,
        check=False,
    )


def build_wheel(folder: Path, *, project: Path = PROJECT, **how: Any) -> tuple[Path, str]:
    """Build a wheel as `build` does and unpack it; the unpacked files, and what was told."""
    done = build("wheel", folder, project=project, **how)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    (wheel,) = folder.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder / "unpacked")  # noqa: S202 - our own
    return folder / "unpacked", done.stderr


def build_sdist(folder: Path, project: Path = PROJECT) -> Path:
    """Build an sdist and unpack it; the top folder of what was in it."""
    done = build("sdist", folder, project=project)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    (sdist,) = folder.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        archive.extractall(folder / "unpacked", filter="data")
    (top,) = (folder / "unpacked").iterdir()
    return top


def version_of(unpacked: Path) -> str:
    """What the command of an unpacked wheel tells of itself."""
    return subprocess.run(
        [sys.executable, "-m", "atlas_cueing", "--version"],
        env={**os.environ, "PYTHONPATH": str(unpacked)},
        cwd=unpacked.parent,
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    ).stdout.strip()
