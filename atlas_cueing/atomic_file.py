"""Files that are there whole or not at all."""

import errno
import os
import stat
from collections.abc import Callable
from pathlib import Path
from secrets import token_hex
from typing import BinaryIO

PAGE_BEGINS = "<!doctype html><!-- atlas_cueing -->"  # a page that begins so is ours to replace
_DOCTYPE = "<!doctype html>"
_MOST_LINKS = 40  # one after the other; Linux follows as many
_OPEN_FILES = ("/proc/", "/dev/fd")  # links there are open files of a process, and no names
_KEPT_NAME = 50  # characters of a name that a passing one begins with; 255 bytes are allowed


class Destination:
    """Where a file goes when it is complete: its real name, and what has that name until then."""

    def __init__(self, file: Path) -> None:
        """Look where `file` leads.

        Raises OSError when something else than a regular file is there.
        """
        self.path = real_file(file)
        self._before = _identity(self.path)

    def passing(self) -> Path:
        """Return a name beside the real file that nobody has yet."""
        name = self.path.name[:_KEPT_NAME]
        return self.path.with_name(f"{name}.{token_hex(4)}.writing")

    def take(self, part: Path) -> None:
        """Give the complete file `part` its name, in place of what was there in the beginning.

        Raises OSError, and leaves both, when another file has come to have that name meanwhile.
        """
        if _identity(self.path) not in (None, self._before):
            raise FileExistsError(errno.EEXIST, "another file has taken its name meanwhile")
        os.replace(part, self.path)


def real_file(file: Path) -> Path:
    """Return the file at the end of a chain of symbolic links; it need not exist.

    Raises OSError for links in a circle, and for the open files of a process (`/dev/stdout`).
    """
    for _ in range(_MOST_LINKS):
        if not file.is_symlink():
            return file
        if os.path.realpath(file.parent).startswith(_OPEN_FILES):
            raise OSError(errno.EINVAL, "is an open file of a process, allowed: a file by its name")
        file = file.parent / os.readlink(file)
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))


def write_whole(file: str | Path, content: str | bytes) -> None:
    """Write a text as UTF-8, or bytes, into `file`, under a passing name until it is complete.

    A character that UTF-8 has no bytes for, as in some names of files, becomes a question mark.
    Raises OSError, leaves what was there, and nothing new.
    """
    whole = content if isinstance(content, bytes) else content.encode(errors="replace")
    write_through(file, lambda new: new.write(whole))


def write_through(file: str | Path, write: Callable[[BinaryIO], object]) -> None:
    """Let `write` fill `file`, which has a passing name until it is complete.

    Raises what `write` raises and OSError, leaves what was there, and nothing new.
    """
    destination = Destination(Path(file))
    part = destination.passing()
    try:
        with part.open("x+b") as new:
            write(new)
        destination.take(part)
    finally:
        part.unlink(missing_ok=True)


def write_page(file: str | Path, html: str) -> None:
    """Write a whole page, with what tells later that it is one of ours. Raises as `write_whole`."""
    write_whole(file, as_page(html))


def as_page(html: str) -> str:
    """Return the page beginning as ours do; any doctype it has is replaced."""
    begins = html[: len(_DOCTYPE)].lower() == _DOCTYPE
    return PAGE_BEGINS + (html[len(_DOCTYPE) :] if begins else html)


def _identity(file: Path) -> tuple[int, int] | None:
    """Device and inode of a regular file, or None when there is nothing; OSError for all else."""
    try:
        found = file.lstat()
    except FileNotFoundError:
        return None
    if not stat.S_ISREG(found.st_mode):
        raise OSError(errno.EINVAL, "exists and is no regular file")
    return found.st_dev, found.st_ino
