"""Where the output of a command may go, found out before anything is done."""

import errno
import os
import stat
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from ..atomic_file import PAGE_BEGINS, real_file
from ..errors import OutputError


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of output: its name for messages, and how a file of this kind begins.

    at: bytes in front of that, which may be anything.
    """

    name: str
    begins: bytes
    at: int = 0

    def may_replace(self, begin: bytes) -> bool:
        """Whether a file that begins so may be replaced by one of this kind.

        It is one, or empty.
        """
        return not begin or begin[self.at :].startswith(self.begins)


LOG: Final = Kind("log", b"\x89MCAP")
PAGE: Final = Kind("page", PAGE_BEGINS.encode())
_ADVICE: Final = "choose another name, or replace it with --force"
TABLE: Final = Kind("table", b"run,source,scenario,vehicle,")  # of a batch


def check_output(
    file: Path,
    kind: Kind = LOG,
    *,
    inputs: Iterable[Path] = (),
    outputs: Iterable[Path] = (),
    force: bool,
    fresh: bool = False,
) -> Path:
    """Find out whether `file` may be written, and where that is when it is a symbolic link.

    Args:
        file: the output as it was asked for.
        kind: what it will be, and so what `force` may replace.
        inputs: files that the same command reads.
        outputs: other files that the same command writes.
        force: whether a file may be replaced, if it is empty or of the same kind.
        fresh: look at the .part beside it as well: what is left of a run that was killed, or that
            of a run which is still going.

    Returns:
        The real file, beside which a passing one may be written and renamed.

    Raises:
        OutputError: it cannot be written, or something would be lost that nobody wants to lose.
    """
    try:
        real = real_file(file)
        _refuse_others(real, inputs, outputs)
        _check_folder(real.parent)
        _check_replaced(real, kind, force, f"exists already; {_ADVICE}")
        if fresh:
            _check_part(real, kind, inputs, force)
    except OSError as error:  # also a name that is too long, a folder that may not be looked into
        raise OutputError(f"{kind.name} {file}: {error.strerror}") from error
    return real


def _refuse_others(real: Path, inputs: Iterable[Path], outputs: Iterable[Path]) -> None:
    for other in inputs:
        if _same(real, other):
            _refuse("is a file that is read; choose another name")
    for other in outputs:
        if _same(real, other):
            _refuse("is written twice; choose another name")


def _same(one: Path, other: Path) -> bool:
    """Whether both are one file, by whatever links, or will be when they are written."""
    try:
        return one.samefile(other)
    except FileNotFoundError:
        return os.path.realpath(one) == os.path.realpath(other)


def _check_folder(folder: Path) -> None:
    if not folder.is_dir():
        _refuse(f"there is no folder {folder}")
    if not os.access(folder, os.W_OK | os.X_OK):
        _refuse(f"folder {folder} cannot be written to")


def _check_replaced(file: Path, kind: Kind, force: bool, refusal: str) -> None:
    """Refuse what is there already, unless `force` is given and it is empty or of the kind."""
    try:
        found = file.lstat()
    except FileNotFoundError:
        return
    if not stat.S_ISREG(found.st_mode):
        _refuse("exists and is no regular file")
    if not force:
        _refuse(refusal)
    if not kind.may_replace(_begin(file, kind.at + len(kind.begins))):
        _refuse(f"is no {kind.name} of atlas-cueing, and nothing else is replaced")
    if _of_another(file.parent, found):
        _refuse(f"belongs to another user, who alone may replace it in {file.parent}")


def _check_part(real: Path, kind: Kind, inputs: Iterable[Path], force: bool) -> None:
    part = real.with_name(f"{real.name}.part")
    there = "is there, of a run that is still going or was killed; save it with"
    remedy = f"atlas-cueing recover {part} -o NAME.mcap, {_ADVICE}"
    try:
        _refuse_others(part, inputs, ())
        _check_replaced(part, kind, force, f"{there} {remedy}")
    except OSError as error:
        _refuse(f"{part} {error.strerror}")


def _begin(file: Path, size: int) -> bytes:
    with file.open("rb") as content:
        return content.read(size)


def _of_another(folder: Path, found: os.stat_result) -> bool:
    """Whether the folder is one like /tmp, in which everybody replaces only what is theirs."""
    around, me = folder.stat(), os.geteuid()
    return bool(around.st_mode & stat.S_ISVTX) and me not in (0, around.st_uid, found.st_uid)


def _refuse(reason: str) -> None:
    raise OSError(errno.EINVAL, reason)
