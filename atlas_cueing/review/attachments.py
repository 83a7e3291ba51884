"""The files inside a log: scenario and platform of the run."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory

from ..errors import LogError, ScenarioError
from ..recording import Log
from ..scenario import Platform, load_platform

SCENARIO, PLATFORM = "scenario.toml", "platform.toml"
LARGEST = 1 << 20  # bytes; a scenario may have 256 kB, a user's script some more
_LONGEST_NAME = 200  # bytes
_DEEPEST = 8  # folders and file; an aircraft has four


@contextmanager
def unpacked(log: Log) -> Iterator[Path]:
    """Unpack the log's files into a folder that is removed at the end of the context.

    Raises LogError for names that lead elsewhere, and for large files.
    """
    _check(log)
    with TemporaryDirectory(prefix="atlas-cueing-") as name:
        folder = Path(name)
        for file, content in log.attachments.items():
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            (folder / file).write_bytes(content)
        yield folder


def platform_of(log: Log) -> Platform:
    """The platform in a log. Raises LogError when there is none, or it cannot be read."""
    if PLATFORM not in log.attachments:
        raise LogError(
            f"{log.path}: the log does not hold {PLATFORM}, so its limits and wheels are unknown"
        )
    with unpacked(log) as folder:
        try:
            return load_platform(str(folder / PLATFORM))
        except ScenarioError as error:
            raise LogError(f"{log.path}: " + as_inside(error, folder)) from error


def as_inside(error: Exception, folder: Path) -> str:
    """The text of an error in one line, with the files in `folder` named as the log's."""
    return "; ".join(str(error).replace(f"{folder}/", "the log's ").splitlines())


def _check(log: Log) -> None:
    files: Mapping[str, bytes] = log.attachments
    folders = {str(folder) for name in files for folder in PurePosixPath(name).parents}
    for name in folders & files.keys():
        raise LogError(f"{log.path}: attachment {name[:60]!r} is a file and a folder")
    for name, content in files.items():
        if not name.isprintable() or not _stays_inside(name) or len(name.encode()) > _LONGEST_NAME:
            allowed = "allowed: names of folders and a file that lead nowhere else"
            raise LogError(f"{log.path}: an attachment is called {name[:60]!r}, {allowed}")
        if len(content) > LARGEST:
            raise LogError(
                f"{log.path}: attachment {name!r} has {len(content)} bytes, allowed: at most"
                f" {LARGEST}"
            )


def _stays_inside(name: str) -> bool:
    """Whether the path of an attachment has plain names only, as `aircraft/mine/mine.xml`."""
    parts = name.split("/")
    return len(parts) <= _DEEPEST and all(part not in ("", ".", "..") for part in parts)
