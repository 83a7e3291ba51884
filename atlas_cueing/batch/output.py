"""Where a log may go, found out before anything flies."""

import os
from pathlib import Path

from ..errors import OutputError


def check_output(log: Path, *, force: bool, fresh: bool = False) -> None:
    """Raise OutputError when `log` cannot be written, or exists and `force` is not given.

    fresh: refuse the .part beside it as well: all that is left of a run that was killed, or one that is still going.
    """
    try:
        _check(log, force)
        part = log.with_name(f"{log.name}.part")
        if fresh and part.exists() and not force:
            raise OutputError(
                f"log {log}: {part} is there, of a run that is still going or was killed; save it with "
                f"atlas-cueing recover {part} -o NAME.mcap, choose another name, or replace it with --force"
            )
    except OSError as error:  # a name that is too long, a folder that may not be looked into
        raise OutputError(f"log {log}: {error.strerror}") from error


def _check(log: Path, force: bool) -> None:
    folder = log.parent
    if log.exists() and not log.is_file():  # replacing a device or a folder would be a bad surprise
        raise OutputError(f"log {log}: exists and is no regular file")
    if not folder.is_dir():
        raise OutputError(f"log {log}: there is no folder {folder}")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise OutputError(f"log {log}: folder {folder} cannot be written to")
    if log.exists() and not force:
        raise OutputError(f"log {log}: exists already; choose another name, or replace it with --force")
