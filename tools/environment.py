"""The project's own environment, `.venv`.

Every tool enters it, so that it can be called as `tools/NAME` from anywhere.

A tool calls `enter` before it imports anything that is not Python's own.
"""

import os
import re
import subprocess
import sys
from importlib import invalidate_caches, metadata
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
PYTHON = PROJECT / ".venv" / "bin" / "python"


def enter(extra: str = "") -> None:
    """Go on in an interpreter that has the project and what its `extra` needs.

    The running one is kept if it has all of it. Otherwise `tools/setup EXTRA` makes .venv ready,
    and the tool starts again there. What is compiled stays compiled, for no tool asks for `dev`;
    what is Python stays Python. From then on Ctrl-C, or a reader that went away, ends it
    without a traceback.
    """
    sys.excepthook = _excepthook
    if not _lacking(extra):
        return
    setup = subprocess.run([PROJECT / "tools" / "setup", *filter(None, [extra])], check=False)
    if setup.returncode:
        sys.exit(setup.returncode)
    if Path(sys.prefix) != PYTHON.parent.parent:
        os.execv(PYTHON, [PYTHON, *sys.argv])  # noqa: S606 no shell is wanted
    invalidate_caches()


def _lacking(extra: str) -> bool:
    """Whether the project, or a dependency of it or of the extra, is not installed here."""
    try:
        for requirement in metadata.requires("atlas_cueing") or ():
            name, _, condition = requirement.partition(";")
            if "extra ==" not in condition or (
                extra and re.search(f"extra == ['\"]{extra}['\"]", condition)
            ):
                metadata.version(re.match(r"[\w.-]+", name)[0])
    except metadata.PackageNotFoundError:
        return True
    return False


def _excepthook(kind, error, trace):
    if issubclass(kind, BrokenPipeError):
        # what is flushed at the end has a place to go
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    elif not issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)
