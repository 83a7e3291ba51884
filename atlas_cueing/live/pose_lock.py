"""One ride at a time for the file with the platform's pose: two would overwrite each other's."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import monotonic, sleep

from ..errors import InputError

# s that a ride may take to be gone: the helpers of one that was killed finish its pose and its log
PATIENCE_S = 2.0
_POLL_S = 0.05


@contextmanager
def locked_pose(file: Path) -> Iterator[None]:
    """Keep `file` for this ride, by flock(2) of FILE.lock beside it.

    Raises InputError when another ride has it, or the lock cannot be made.
    """
    lock = Path(f"{Path(os.path.realpath(file))}.lock")
    missing = [folder for folder in lock.parents if not folder.exists()]
    try:
        lock.parent.mkdir(parents=True, exist_ok=True)
        number = _lock(file, lock)
    except OSError as error:
        raise InputError(
            f"pose {file}: cannot be locked: {error.filename or lock}: {error.strerror}"
        ) from error
    try:
        os.ftruncate(number, 0)
        os.write(number, b"%d\n" % os.getpid())
        yield
    finally:
        # under the lock, so that nobody waits for a file that is no longer there
        lock.unlink(missing_ok=True)
        fcntl.flock(number, fcntl.LOCK_UN)  # for the copies of the helpers, too
        os.close(number)
        for folder in missing:
            with suppress(OSError):  # it is in use
                folder.rmdir()


def _lock(file: Path, lock: Path) -> int:
    """Return the descriptor of the lock that is held."""
    deadline = monotonic() + PATIENCE_S
    while True:
        number = os.open(lock, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if _is_at(number, lock):
                return number
        except BlockingIOError:
            if monotonic() >= deadline:
                holder = os.read(number, 20).decode(errors="replace").strip() or "unknown"
                os.close(number)
                raise InputError(
                    f"pose {file}: another ride has it, that of process {holder}; two cannot drive"
                    " one platform: end that one first, or say --pose for another platform"
                ) from None
            sleep(_POLL_S)
        os.close(number)


def _is_at(number: int, lock: Path) -> bool:
    """Whether the lock is still in its place: its last holder takes it away."""
    with suppress(FileNotFoundError):
        return os.path.samestat(os.fstat(number), lock.stat())
    return False
