"""A log in memory as a new file."""

from collections.abc import Mapping
from pathlib import Path

from ..errors import OutputError
from .container import Container
from .log import Log
from .log_writer import write_log
from .part_file import PartFile


def rewrite_log(log: Log, metadata: Mapping[str, str], output: Path) -> None:
    """Write columns, states, poses and files of `log` as the complete log `output`.

    Log times are kept. Whether a file there may be replaced is for the caller to decide.

    Raises OutputError when it cannot be written; then nothing is left of it.
    """
    try:
        file = PartFile(output)
    except OSError as error:
        raise OutputError(f"cannot write log {output}: {error.strerror or error}") from error
    try:
        write_log(Container(file.write), log, metadata)
        file.complete()
    except OSError as error:
        file.path.unlink(missing_ok=True)
        raise OutputError(f"cannot write log {output}: {error.strerror or error}") from error
    finally:
        file.release()
