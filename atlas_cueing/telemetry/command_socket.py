"""The local socket for the operator's commands to a live run, and whoever speaks to it.

It is a UNIX stream socket of the user alone, $XDG_RUNTIME_DIR/atlas_cueing/PID.sock (mode 0600, in
a folder of mode 0700), where PID is the loop's process. One word a line, a line of answer to each:

    echo hold | socat - UNIX-CONNECT:$XDG_RUNTIME_DIR/atlas_cueing/4711.sock
"""

import os
import socket
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

from ..errors import InputError

LONGEST_LINE = 100  # bytes of a command
PATIENCE = 5.0  # s that an answer may take
_BACKLOG = 4
_LONGEST_PATH = 107  # bytes of sun_path, unix(7)


def folder() -> Path:
    """Return the folder of the sockets: the session's, or one of the user's own."""
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    if os.path.isabs(runtime):
        return Path(runtime) / "atlas_cueing"
    return Path(tempfile.gettempdir()) / f"atlas_cueing-{os.getuid()}"


def open_socket(pid: int) -> tuple[Path, socket.socket]:
    """Return the path of the loop's socket and the socket, which listens and never waits.

    Raises InputError where there can be none, as in a folder that others can write.
    """
    place = folder() / f"{pid}.sock"
    if len(os.fsencode(place)) > _LONGEST_PATH:
        raise InputError(f"no command socket: {place} is longer than {_LONGEST_PATH} bytes")
    listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        place.parent.mkdir(mode=0o700, exist_ok=True)
        _check_own(place.parent)
        place.unlink(missing_ok=True)  # of a loop that was killed and had this number
        mask = os.umask(0o177)
        try:
            listener.bind(str(place))
        finally:
            os.umask(mask)
        listener.listen(_BACKLOG)
        listener.setblocking(False)
    except OSError as error:
        listener.close()
        raise InputError(f"no command socket: {place}: {error.strerror or error}") from error
    return place, listener


def _check_own(directory: Path) -> None:
    found = directory.lstat()
    if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.getuid() or found.st_mode & 0o077:
        raise OSError(0, "its folder is not the user's alone (mode 0700)")


def newest() -> Path:
    """Return the socket of the run that began last and still listens.

    Raises InputError for none.
    """
    sockets = []
    for place in folder().glob("*.sock"):
        with suppress(OSError):
            sockets.append((place.stat().st_mtime_ns, place))
    for _, place in sorted(sockets, reverse=True):
        with suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as probe:
            probe.settimeout(PATIENCE)
            probe.connect(str(place))
            return place
    raise InputError(f"no live run listens in {folder()}")


def ask(place: Path, word: str) -> str:
    """Send one command and return the answer's line.

    Raises InputError when no run listens there or it does not answer.
    """
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as line:
            line.settimeout(PATIENCE)
            line.connect(str(place))
            line.sendall(f"{word}\n".encode())
            with line.makefile("rb") as answers:
                answer = answers.readline(4096).decode(errors="replace").strip()
    except OSError as error:
        raise InputError(
            f"{place}: no live run answers there: {error.strerror or error}"
        ) from error
    if not answer:
        raise InputError(f"{place}: the live run ended without an answer")
    return answer
