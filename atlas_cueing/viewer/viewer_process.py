"""Starts and ends the process that shows a live run."""

import os
import signal
import sys
import time
from collections.abc import Callable, Collection, Mapping
from multiprocessing import get_context
from multiprocessing.connection import Connection
from types import TracebackType

from ..errors import AtlasError, InputError
from ..scenario import Platform
from ..telemetry import Ring, RingReader
from .gate import HOST
from .server import check_viser

_REFRESH = 0.04  # s
_NICENESS = 10  # the loop comes first
_PATIENCE = 60.0  # s; viser starts in 0.3 s on an idle machine


class ViewerProcess:
    """A page that shows what comes through `ring` and gives its button presses to `press`.

    To be started before the loop: by `fork`, which shares the ring and what `press` writes to. It
    never holds the writer up, for it only reads. After the ring's END the page stays; the process
    ends with `close`, or when this process does.
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
        """Start to serve at `port`, 0 for any free one.

        `press` is called in the other process with the name of a button that `allowed` has for the
        present state. Raises InputError when viser is missing or the port is in use.
        """
        check_viser("live")
        context = get_context("fork")
        here, there = context.Pipe(duplex=False)
        self._process = context.Process(
            target=_show,
            args=(there, os.getpid(), ring, platform, press, allowed, port, title),
            name="viewer",
            daemon=True,
        )
        self._process.start()
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
        self.url = f"http://{HOST}:{answer}"

    @property
    def pid(self) -> int | None:
        """Of the process; None before it has one."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether it still serves."""
        return self._process.is_alive()

    def close(self) -> None:
        """End the page."""
        self._process.terminate()
        self._process.join(1.0)
        if self._process.is_alive():  # it has been stopped, or is busy
            self._process.kill()
            self._process.join()

    def __enter__(self) -> "ViewerProcess":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def _show(
    answer: Connection,
    parent: int,
    ring: Ring,
    platform: Platform,
    press: Callable[[str], object],
    allowed: Mapping[str, Collection[str]],
    port: int,
    title: str | None,
) -> None:
    """Serve until the parent is gone."""
    reader = RingReader(ring)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the loop, which then closes this
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    os.nice(_NICENESS)
    # For the rest of this process; results of the program go to stdout
    sys.stdout = open(os.devnull, "w")  # noqa: SIM115
    from .live_page import LivePage
    from .server import open_server

    try:
        server = open_server(port, title)
        page = LivePage(server, platform, press, allowed)
        answer.send(server.get_port())
    except AtlasError as error:
        answer.send(str(error))
        return
    while os.getppid() == parent:
        page.take(reader.newest())
        page.refresh()
        time.sleep(_REFRESH)
