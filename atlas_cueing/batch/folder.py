"""The folder of results: made when needed, and one batch at a time in it."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import OutputError

LOCK = ".batch.lock"


def check_folder(folder: Path) -> None:
    """Raise OutputError when `folder` cannot become, or is not, a folder to write to. Makes nothing."""
    try:
        existing = folder if folder.exists() else folder.parent
        if not existing.is_dir():
            raise OutputError(f"folder {folder}: {existing} is {'no folder' if existing.exists() else 'missing'}")
        if not os.access(existing, os.W_OK | os.X_OK):
            raise OutputError(f"folder {folder}: {existing} cannot be written to")
    except OSError as error:  # a name that is too long, a folder that may not be looked into
        raise OutputError(f"folder {folder}: {error.strerror}") from error


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Make the folder and hold it. Raises OutputError while another batch of this machine holds it."""
    check_folder(folder)
    folder.mkdir(exist_ok=True)
    with (folder / LOCK).open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)  # the system lets go of it however the driver ends
        except OSError as error:
            raise OutputError(f"folder {folder}: another batch is at work in it") from error
        yield
