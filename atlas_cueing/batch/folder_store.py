"""Results in a folder: made when needed, and one batch at a time in it."""

import fcntl
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path
from typing import TextIO

from ..atomic_file import write_whole
from ..errors import OutputError
from .isolation import linger

LOCK = ".batch.lock"
RUNS_LOCK = ".runs.lock"  # a byte of it for each run
_BYTES = 6  # of a run's hash, which is the number of its byte
_PATIENCE = 0.2  # s from one look at a run that another worker holds to the next


class FolderStore:
    """`Results` in a folder, which workers elsewhere see at the same path.

    Runs write into it at once.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    @property
    def place(self) -> str:
        """The absolute path of the folder."""
        return str(self._folder.resolve())

    @property
    def title(self) -> str:
        """Name of the folder."""
        return self._folder.resolve().name

    def where(self, name: str = "") -> str:
        """Path as it was given."""
        return str(self._folder / name)

    def check(self) -> None:
        """Raise OutputError when the folder cannot become, or is not, one to write to.

        Makes nothing.
        """
        folder = self._folder
        try:
            existing = folder if folder.exists() else folder.parent
            if not existing.is_dir():
                raise OutputError(
                    f"folder {folder}: {existing} is"
                    f" {'no folder' if existing.exists() else 'missing'}"
                )
            if not os.access(existing, os.W_OK | os.X_OK):
                raise OutputError(f"folder {folder}: {existing} cannot be written to")
        except OSError as error:  # a name that is too long, a folder that may not be looked into
            raise OutputError(f"folder {folder}: {error.strerror}") from error

    @contextmanager
    def opened(self) -> Iterator[None]:
        """Make the folder and hold it.

        Raises OutputError while another batch of this machine holds it.
        """
        self.check()
        with self._lock_file() as lock:
            try:
                # the system lets go of it however the driver ends
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as error:
                raise OutputError(
                    f"folder {self._folder}: another batch is at work in it"
                ) from error
            yield

    def _lock_file(self) -> TextIO:
        try:
            self._folder.mkdir(exist_ok=True)
            return (self._folder / LOCK).open("w")
        except OSError as error:
            raise OutputError(f"folder {self._folder}: {error.strerror}") from error

    @contextmanager
    def claimed(self, run: str) -> Iterator[None]:
        """Hold a run while entered, on all machines whose file system keeps locks.

        Wait as long as another worker holds it.

        Raises EOFError when this process's stdin ends meanwhile.
        """
        with (self._folder / RUNS_LOCK).open("a") as lock:
            while not _locked(lock, int.from_bytes(sha256(run.encode()).digest()[:_BYTES])):
                linger(_PATIENCE)
            yield

    def has(self, name: str) -> bool:
        """Whether a file is there."""
        return (self._folder / name).is_file()

    def names(self) -> set[str]:
        """Everything in the folder; nothing while there is none."""
        return set(os.listdir(self._folder)) if self._folder.exists() else set()

    def read(self, names: Iterable[str]) -> dict[str, bytes]:
        """Contents of files by name; one that cannot be read is left out."""
        found = {}
        for name in names:
            with suppress(OSError):
                found[name] = (self._folder / name).read_bytes()
        return found

    def write(self, name: str, content: bytes) -> None:
        """Write a file, complete or not at all. Raises OutputError."""
        try:
            write_whole(self._folder / name, content)
        except OSError as error:
            raise OutputError(f"{self._folder / name}: {error.strerror}") from error

    def workdir(self, scratch: Path) -> Path:  # noqa: ARG002 - it is not needed here
        """The folder itself: who writes there renames what is complete."""
        return self._folder

    def deliver(self, workdir: Path, names: Iterable[str]) -> None:
        """Nothing: the workdir is the folder."""

    def fetch(self, name: str, scratch: Path) -> Path:  # noqa: ARG002 - it is not needed here
        """The file itself."""
        return self._folder / name


def _locked(file: TextIO, byte: int) -> bool:
    """Lock a byte, until the file is closed or the process ends.

    False when another process has it.
    """
    try:
        fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, byte)
    except (BlockingIOError, PermissionError):  # POSIX leaves it open which of them
        return False
    return True
