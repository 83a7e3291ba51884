"""A function in a process of its own, which may crash, hang or be killed by itself alone."""

import os
import signal
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from select import select
from time import monotonic
from typing import BinaryIO

_PIECE = 65536  # bytes read at a time
_TAIL = 300  # characters of what a child printed last
_STDIN = 0  # its other end is held by the driver; when it ends, the child is not wanted any more
_PARENT_DEATH = 1  # PR_SET_PDEATHSIG of Linux's prctl


@dataclass(frozen=True, slots=True)
class ChildExit:
    """How a child process ended.

    answer: what its work returned.
    status: its exit status; the number of a signal, below zero.
    printed: the end of what it printed.
    late: whether it was killed at its time limit.
    """

    answer: bytes
    status: int
    printed: str
    late: bool

    def how(self) -> str:
        """Return a phrase that says how it ended."""
        how = (
            f"ended by {signal.Signals(-self.status).name}"
            if self.status < 0
            else f"ended with exit status {self.status}"
        )
        return f"{how}{': ' if self.printed else ''}{self.printed}"


def in_child(work: Callable[[], bytes], limit: float) -> ChildExit:
    """Call `work` in a forked process, and return how that ended.

    The child is killed after `limit` s of wall time, and dies with this process (on Linux).

    To be called in a process without threads, which a fork would catch in mid-step; `work` may
    start some. Raises EOFError when this process's stdin ends meanwhile: the child is killed, since
    its driver has ended.
    """
    with tempfile.TemporaryFile() as printed:
        reading, writing = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(reading)
            _work_and_exit(work, writing, printed)
        os.close(writing)
        answer = None
        try:
            answer = _listen(reading, monotonic() + limit)
        finally:
            os.close(reading)
            if answer is None:
                os.kill(child, signal.SIGKILL)
            _, status = os.waitpid(child, 0)
        printed.seek(0)
        last = " ".join(printed.read().decode(errors="replace").split())[-_TAIL:]
    return ChildExit(answer or b"", os.waitstatus_to_exitcode(status), last, late=answer is None)


def linger(time: float) -> None:
    """Wait `time` s. Raises EOFError when this process's stdin ends meanwhile."""
    if select([_STDIN], [], [], time)[0]:
        raise EOFError("the driver has ended")


def _listen(reading: int, deadline: float) -> bytes | None:
    """Return what the child writes until it ends; None when that is later than the deadline."""
    answer = bytearray()
    while (left := deadline - monotonic()) > 0.0:
        ready, _, _ = select([reading, _STDIN], [], [], left)
        if reading in ready:
            piece = os.read(reading, _PIECE)
            if not piece:
                return bytes(answer)
            answer += piece
        elif ready:
            raise EOFError("the driver has ended")
    return None


def _work_and_exit(work: Callable[[], bytes], writing: int, printed: BinaryIO) -> None:
    """Call `work` in the child, write its answer, and exit."""
    status = 1
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        die_with_parent()
        with open(os.devnull) as nothing:  # what comes on stdin is not for it
            os.dup2(nothing.fileno(), _STDIN)
        os.dup2(printed.fileno(), 1)
        os.dup2(printed.fileno(), 2)
        answer = work()
        while answer:
            answer = answer[os.write(writing, answer) :]
        status = 0
    except BaseException as error:  # noqa: BLE001 - the parent's code must not go on in the child
        os.write(2, f"{type(error).__name__}: {error}".encode())
    finally:
        os._exit(status)


def die_with_parent() -> None:
    """Let this process be killed when its parent ends (on Linux; elsewhere it goes on)."""
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None).prctl(_PARENT_DEATH, signal.SIGKILL, 0, 0, 0)
