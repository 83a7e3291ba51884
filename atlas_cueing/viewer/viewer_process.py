"""The process that shows a live run."""

import os
import secrets
import sys
import time
from collections.abc import Callable, Collection, Mapping
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from types import TracebackType
from typing import TYPE_CHECKING, Self

from ..errors import AtlasError, InputError
from ..scenario import Platform
from ..telemetry import ChildProcess, Left, Ring, RingReader
from .gate import HOST
from .server import check_viser, open_server

if TYPE_CHECKING:
    from .live_page import LivePage

_REFRESH = 0.04  # s
_TOKEN = 16  # bytes
_NICENESS = 10  # the loop comes first
_PATIENCE = 60.0  # s; viser starts in 0.3 s on an idle machine
_CLOSING = 1.0  # s that the process may take to end


class ViewerProcess:
    """A page that shows what comes through a ring, and takes the operator's buttons.

    Its address holds a random token: a program of another user of this machine, or a page that got
    round the gate, cannot press what it does not know.

    It has to be started before the loop: by `fork`, which shares the ring and what `press` writes
    to. It never holds the writer up, for it only reads. After the ring's END the page stays; the
    process ends with `close`, or when this process does.
    """

    def __init__(
        self,
        ring: Ring,
        platform: Platform,
        press: Callable[[str], object],
        allowed: Mapping[str, Collection[str]],
        *,
        port: int = 0,
        title: str | None = None,
    ) -> None:
        """Fork the process, and wait until it serves.

        Args:
            ring: of the live run.
            platform: to draw.
            press: called in the new process with the name of a button.
            allowed: the buttons that can be pressed, by the name of the state.
            port: of 127.0.0.1; 0 takes a free one.
            title: of the page.

        Raises InputError when viser is missing or the port is in use.
        """
        check_viser("live")
        token = secrets.token_urlsafe(_TOKEN)

        def start() -> "tuple[LivePage, int]":
            """Open the page in the new process; give it and its port."""
            from .live_page import LivePage

            server = open_server(port, title, token)
            return LivePage(server, platform, press, allowed), server.get_port()

        here, there = Pipe(duplex=False)
        self._process = ChildProcess(lambda left: _show(start, there, RingReader(ring), left))
        there.close()
        try:
            answer = here.recv() if here.poll(_PATIENCE) else "no answer"
        except EOFError:
            answer = "its process ended"
        finally:
            here.close()
        if not isinstance(answer, int):
            self.close()
            raise InputError(f"the view could not be started: {answer}")
        self.url = f"http://{HOST}:{answer}/{token}"

    @property
    def pid(self) -> int:
        """Process id of the viewer."""
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
        """End the process, by force if it is stopped or busy."""
        self._process.finish(_CLOSING)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def _show(
    start: "Callable[[], tuple[LivePage, int]]", answer: Connection, reader: RingReader, left: Left
) -> bytes:
    """Serve until the parent closes the viewer or is gone."""
    os.nice(_NICENESS)
    # For the rest of this process; results of the program go to stdout
    sys.stdout = open(os.devnull, "w")  # noqa: SIM115
    try:
        page, port = start()
    except AtlasError as error:
        answer.send(str(error))
        return b""
    left()  # it may have taken long: no sign that it hangs
    answer.send(port)
    while not left():
        page.take(reader.newest())
        page.refresh()
        time.sleep(_REFRESH)
    return b""
