"""The file that a log is written to until it is complete."""

import errno
import fcntl
import os
import stat
from pathlib import Path

from ..atomic_file import Destination

# Neither a link is followed nor a FIFO's reader waited for.
_OPENING = os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK


class PartFile:
    """The `.part` beside the place of a log, empty at first, which no other process writes.

    It takes the log's name when it is complete; one that is dropped stays what it is. Every call
    may raise OSError.
    """

    def __init__(self, path: Path) -> None:
        """Open it, for a log at `path`; a link there is followed."""
        self._file = -1
        self._destination = Destination(path)
        if self.path.is_symlink():
            raise OSError(errno.ELOOP, f"{self.path} is a symbolic link")
        self._file = os.open(self.path, _OPENING, 0o666)
        if not stat.S_ISREG(os.fstat(self._file).st_mode):
            raise OSError(errno.EINVAL, f"{self.path} is no regular file")
        self._hold()
        if os.fstat(self._file).st_size:
            os.ftruncate(self._file, 0)

    @property
    def path(self) -> Path:
        """Where it is, beside the real file."""
        return self._destination.path.with_name(f"{self._destination.path.name}.part")

    def write(self, data: bytes) -> None:
        """Write all of data: a full disk first takes a part of it."""
        view = memoryview(data)
        while view:
            view = view[os.write(self._file, view) :]

    def sync(self) -> None:
        """Let the disk take what was written up to now, against a power cut."""
        os.fdatasync(self._file)

    def complete(self) -> None:
        """Give it the log's name."""
        os.fsync(self._file)  # or a power cut could leave the name without its bytes
        self.release()
        self._destination.take(self.path)

    def release(self) -> None:
        """Close it as it is; harmless afterwards."""
        file, self._file = self._file, -1
        if file >= 0:
            os.close(file)

    def __del__(self) -> None:
        self.release()

    def _hold(self) -> None:
        """Keep others from writing the same log, until it is closed."""
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise OSError(error.errno, "another run is writing it") from error
