"""A child process that is forked before the loop starts and follows it, until either ends."""

import os
import signal
import socket
import traceback
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from mmap import mmap
from time import monotonic
from typing import NoReturn, TypeAlias

Left: TypeAlias = Callable[[], bool]
"""Returns whether the parent has ended or waits in `finish`: nothing more will come from it."""

HANGS_S = 5.0  # s without a call of Left after which a process counts as hanging (assumed)
_FAILED = 70  # exit status after an exception: EX_SOFTWARE of sysexits.h
# a terminal sends them to all its processes; the loop decides what they mean
_IGNORED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


@dataclass(frozen=True, slots=True)
class ProcessExit:
    """How a process ended.

    answer: what its function returned; empty if it did not return.
    status: exit status; negative for the signal that killed it.
    """

    answer: bytes
    status: int


class ChildProcess:
    """A function in a process of its own, with the memory that is shared at the fork.

    The process ignores SIGINT, SIGTERM and SIGHUP; it lives until its function returns.

    pid: process id.
    """

    def __init__(self, function: Callable[[Left], bytes]) -> None:
        """Fork and run `function`.

        It has to call the Left it is given every now and then, and to return soon after that has
        returned True.
        """
        self._channel, theirs = socket.socketpair()
        # when it last called Left, s; shared, and written at once: `struct` would write it by bytes
        self._beat = memoryview(mmap(-1, 8)).cast("d")
        self._beat[0] = monotonic()
        self._ended: ProcessExit | None = None
        parent = os.getpid()
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, _IGNORED)
        self.pid = os.fork()
        if self.pid == 0:
            self._channel.close()
            _run(function, theirs, parent, mask, self._beat)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        theirs.close()

    @property
    def alive(self) -> bool:
        """Whether it runs; does not wait."""
        return (
            self._ended is None
            and os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None
        )

    @property
    def answers(self) -> bool:
        """Whether it runs, and has called Left in the last HANGS_S; does not wait."""
        return monotonic() - self._beat[0] < HANGS_S and self.alive

    def finish(self, timeout: float) -> ProcessExit:
        """Wait for its end, at most `timeout` s; then it is killed.

        A second call is harmless.
        """
        if self._ended is None:
            answer = self._answer(monotonic() + timeout)
            self._channel.close()
            _, status = os.waitpid(self.pid, 0)
            self._ended = ProcessExit(answer, os.waitstatus_to_exitcode(status))
        return self._ended

    def _answer(self, deadline: float) -> bytes:
        """Return what its function returned; the end of that is the end of the process."""
        answer = b""
        try:
            self._channel.shutdown(socket.SHUT_WR)
            while True:
                self._channel.settimeout(max(deadline - monotonic(), 1e-3))
                piece = self._channel.recv(4096)
                if not piece:
                    return answer
                answer += piece
        except OSError:  # a TimeoutError, or it has ended and left the shutdown unread
            # we have not waited for it yet, so the number is still its own
            os.kill(self.pid, signal.SIGKILL)
            return b""


def _run(
    function: Callable[[Left], bytes],
    channel: socket.socket,
    parent: int,
    mask: Iterable[int],
    beat: "memoryview[float]",
) -> NoReturn:
    """Run the function in the forked process, and end it without the parent's own clean-up."""
    status = _FAILED
    try:
        for number in _IGNORED:
            signal.signal(number, signal.SIG_IGN)
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        channel.setblocking(False)
        answer = function(lambda: _left(channel, parent, beat))
        status = 0
        with suppress(OSError):  # the parent has ended
            channel.sendall(answer)
    except BaseException:  # noqa: BLE001 - must not climb into a copy of the parent's stack
        traceback.print_exc()
    finally:
        os._exit(status)


def _left(channel: socket.socket, parent: int, beat: "memoryview[float]") -> bool:
    """Return whether the parent has left, see Left; it learns that this process does not hang.

    The parent's process id is looked at, too: a sibling may hold a copy of its end of the channel.
    """
    beat[0] = monotonic()
    if os.getppid() != parent:
        return True
    try:
        return channel.recv(1) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True
