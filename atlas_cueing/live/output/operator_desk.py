"""The operator's desk of a live run: tells its states, and takes commands without a browser.

It is a process of its own, as the recorder is: a disk that holds the recorder up, or its death,
does not silence it, and no command can hold the loop up. Commands come by a local socket
(`telemetry.command_socket`) and, where somebody can type, on stdin.
"""

import os
import signal
import socket
import stat
import sys
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from select import select
from time import sleep
from typing import Final

from ...printable import printable
from ...signals import LIVE_STATES
from ...telemetry import ChildProcess, Left, Ring, RingReader
from ...telemetry.command_socket import LONGEST_LINE
from ...telemetry.messages import END, STATUS, TICK, numbers, status
from ..control.state_machine import allowed_commands
from .ring_recorder import report_on_stderr

POLL_S = 0.02  # s between two looks at ring and commands
MOST_CLIENTS = 8
_STDIN = 0
_CLOSING = 1.0  # s that the process may take to end
_STATE: Final = -3  # place of /timing's state in a live row: two fields follow


class OperatorDesk:
    """Runs the desk's process until `close`, or until the loop's process is gone."""

    def __init__(
        self,
        ring: Ring,
        press: Callable[[str], object],
        listener: socket.socket | None = None,
        *,
        announce: bool = True,
        typed: bool = True,
    ) -> None:
        """Fork the process, before the loop starts.

        Args:
            ring: of the live run.
            press: called in the new process with the name of a command.
            listener: of commands; it goes over to the new process.
            announce: report every change of state on stderr.
            typed: take commands from stdin, unless it is a file.
        """
        desk = Desk(ring, press, announce=announce)
        self._process = ChildProcess(lambda left: _serve(desk, listener, typed, left))
        if listener:
            listener.close()

    @property
    def pid(self) -> int:
        """Process id of the desk."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether it serves."""
        return self._process.alive

    @property
    def answers(self) -> bool:
        """Whether it serves, and does not hang (`ChildProcess.answers`)."""
        return self._process.answers

    def close(self) -> None:
        """End the process; what is in the ring by then is still told."""
        self._process.finish(_CLOSING)


class Desk:
    """Follows the ring, and answers commands by the state that it has come to.

    state: of the platform, by its name; time: of the last tick, s.
    """

    def __init__(
        self,
        ring: Ring,
        press: Callable[[str], object],
        *,
        announce: bool = True,
        report: Callable[[str], None] = report_on_stderr,
        allowed: Mapping[str, Collection[str]] | None = None,
    ) -> None:
        """Read `ring` from its next message on; `allowed` are the commands by state."""
        self._reader, self._press = RingReader(ring), press
        self._announce, self._report = announce, report
        self._allowed = allowed_commands() if allowed is None else allowed
        self._words = sorted({word for words in self._allowed.values() for word in words})
        self.state, self.time, self._ended = LIVE_STATES[0], 0.0, False

    def follow(self) -> None:
        """Take over what is new in the ring."""
        for kind, data in self._reader.messages():
            if kind == TICK:
                row = numbers(data)
                self.time, self.state = row[0], LIVE_STATES[int(row[_STATE])]
            elif kind == STATUS:
                new = status(data)
                self.state = new.state
                if self._announce:
                    self._report(f"{new.time:7.2f} s  {new.state}  {new.reason}".rstrip())
            elif kind == END:
                self._ended = True

    def answer(self, line: str) -> str:
        """Carry out one command, and return what to say to it.

        It begins with ok where it has an effect, and with no where it has none.
        """
        word = line.strip().lower()
        if word == "state":
            return f"ok: {self.state} at {self.time:.2f} s"
        if word not in self._words:
            return f"no: {word[:LONGEST_LINE]!r}, allowed: {', '.join(self._words)}, state"
        if self._ended or word not in self._allowed.get(self.state, ()):
            state = "the run is over" if self._ended else self.state.replace("_", " ")
            return f"no: {word} does nothing when {state}"
        self._press(word)
        return f"ok: {word} asked at {self.time:.2f} s, {self.state}"

    def take_typed(self, line: str) -> None:
        """Carry out one command that was typed; the answer goes where states are told."""
        if line.strip():
            self._report(f"{self.time:7.2f} s  {self.answer(line)}")


class _Line:
    """A source of lines: a client of the socket, or stdin."""

    def __init__(self, number: int, take: Callable[[str], None]) -> None:
        self.number, self._take, self._rest = number, take, b""

    def read(self) -> bool:
        """Take what has come, a line at a time; return whether more may come."""
        try:
            piece = os.read(self.number, 4 * LONGEST_LINE)
        except BlockingIOError:
            return True
        except OSError:  # EIO: a terminal that this process is not in the foreground of
            return os.isatty(self.number)
        *lines, self._rest = (self._rest + piece).split(b"\n")
        if not piece or len(self._rest) > LONGEST_LINE:
            lines, self._rest = [*lines, self._rest], b""
        for line in lines:
            if line.strip():
                self._take(printable(line.decode(errors="replace")))
        return bool(piece)


def _serve(desk: Desk, listener: socket.socket | None, typed: bool, left: Left) -> bytes:
    """Serve until the loop's process closes the desk or is gone."""
    # a read from the background would stop the loop, too: the signal goes to the whole group
    signal.signal(signal.SIGTTIN, signal.SIG_IGN)
    sources: dict[int, tuple[_Line, socket.socket | None]] = {}
    if typed and _somebody_types():
        sources[_STDIN] = _Line(_STDIN, desk.take_typed), None
    while True:
        last = left()
        desk.follow()
        if last:
            return b""
        waiting = [*sources, *([listener.fileno()] if listener else [])]
        ready, _, _ = select(waiting, [], [], POLL_S)
        for number in ready:
            if listener and number == listener.fileno():
                _accept(listener, desk, sources)
            elif not sources[number][0].read():
                _, client = sources.pop(number)
                if client:
                    client.close()
        if _STDIN in ready:
            sleep(POLL_S)  # no faster, whoever writes there


def _accept(
    listener: socket.socket, desk: Desk, sources: dict[int, tuple[_Line, socket.socket | None]]
) -> None:
    with suppress(OSError):
        client, _ = listener.accept()
        client.setblocking(False)
        if len(sources) > MOST_CLIENTS:
            client.close()
            return

        def reply(line: str) -> None:
            """Send the answer to one line of the client."""
            with suppress(OSError):  # a client that reads nothing gets nothing
                client.send(f"{desk.answer(line)}\n".encode())

        sources[client.fileno()] = _Line(client.fileno(), reply), client


def _somebody_types() -> bool:
    """Whether stdin is a terminal, pipe or socket: a file may be meant for the next command."""
    try:
        mode = os.fstat(_STDIN).st_mode
    except OSError:
        return False
    return not stat.S_ISREG(mode) and sys.stdin is not None
