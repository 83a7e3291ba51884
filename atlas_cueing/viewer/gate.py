"""A gate for viser's server, which has none.

What web pages of other hosts ask for, and too much of anything, never gets in.

Browsers let any page of the web connect to any port of this machine, but tell where the page is
from (Origin; RFC 6455, 10.2) and under which name it found the server (Host: not ours when a name
server was made to point here). Both are looked at before the handshake: later, messages of a client
that is being shut out would still be read.
"""

import asyncio
import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any
from urllib.parse import urlsplit

HOST = "127.0.0.1"
MOST_CLIENTS = 16  # pages at a time; each gets everything, and keeps 2 MB here
# of any kind, those that have not yet said what they want among them; a page opens a few
MOST_CONNECTIONS = 64
PATIENCE_S = 5.0  # s that a handshake may take
LARGEST_MESSAGE = 65536  # bytes from a page; a button or a camera takes some hundred
_OURS = frozenset((HOST, "localhost", "::1"))

_log = logging.getLogger(__name__)
_log.addHandler(logging.NullHandler())  # one client's nonsense is nobody's news

# (connection, request) to a response, or None to go on with the handshake
Answer = Callable[[Any, Any], Any]


@contextmanager
def gated() -> Iterator[None]:
    """Servers that viser opens in here have the gate.

    It passes no options on to them, so that theirs are replaced.
    """
    from websockets.asyncio import server

    serve: Any = server.serve
    server.serve = _with_gate(serve, server.ServerConnection)  # type: ignore[assignment, misc]
    try:
        yield
    finally:
        server.serve = serve  # type: ignore[misc]


def silence(loop: asyncio.AbstractEventLoop | None) -> None:
    """Let tasks of viser's loop that fail on a client's nonsense do so without a traceback on stderr."""
    assert loop is not None, "viser has started"  # noqa: S101
    loop.set_exception_handler(
        lambda _, context: _log.debug("%s", context["message"], exc_info=context.get("exception"))
    )


def _with_gate(serve: Callable[..., Any], connection: type[Any]) -> Callable[..., Any]:
    class Counted(connection):  # type: ignore[misc]
        """A connection for which another may have to go."""

        def connection_made(self, transport: asyncio.BaseTransport) -> None:
            """Take it up; when there are too many, the one goes that has said nothing for longest."""
            super().connection_made(transport)
            held = [each for each in self.server.handlers if not each.transport.is_closing()]
            if len(held) > MOST_CONNECTIONS:
                next(each for each in held if each.request is None).transport.abort()

    def gated_serve(
        handler: Any, host: Any, port: Any, *, process_request: Answer, **options: Any
    ) -> Any:
        """As `serve`, with the gate before every handshake and bounds on what a client may send."""
        ours = {
            "max_size": LARGEST_MESSAGE,
            "open_timeout": PATIENCE_S,
            "create_connection": Counted,
            "logger": _log,
        }
        return serve(
            handler, host, port, process_request=_admitting(process_request), **options | ours
        )

    return gated_serve


def _admitting(process: Answer) -> Answer:
    def admit(connection: Any, request: Any) -> Any:
        """A refusal, or whatever the server itself answers."""
        if not admits(request.headers.get_all("Host"), request.headers.get_all("Origin")):
            return connection.respond(403, "not for pages of other hosts\n")
        if "Upgrade" in request.headers and len(connection.server.connections) >= MOST_CLIENTS:
            return connection.respond(503, "too many clients\n")
        try:
            return process(connection, request)
        except (OSError, ValueError):  # a name of thousands of characters
            return connection.respond(404, "not found\n")

    return admit


def admits(hosts: list[str], origins: list[str]) -> bool:
    """Whether all Host and Origin headers of a request name this machine.

    Programs send no Origin.
    """
    return all(_is_ours(f"//{host}") for host in hosts) and all(
        _is_ours(origin) for origin in origins
    )


def _is_ours(url: str) -> bool:
    try:
        return urlsplit(url).hostname in _OURS
    except ValueError:  # no URL at all
        return False
