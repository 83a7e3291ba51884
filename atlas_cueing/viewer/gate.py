"""A gate for viser's server, which has none.

It keeps out requests of web pages of other hosts, those of programs that do not know the page's
address where that holds a token, and too much of anything. Browsers let any page
of the web connect to any port of this machine, but send where the page is from (Origin; RFC 6455,
10.2) and under which name it found the server (Host: another name than this machine's when a name
server was made to point here). Both are checked before the handshake: later, messages of a client
that is being shut out would still be read.

The gate is inside viser's server rather than a proxy as `telemetry.OriginGate`: the largest message
of a client (viser allows 50 MB), the replies to bad requests and the log of the server are options
that only the server itself can have.
"""

import asyncio
import hmac
import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ..telemetry.origin_gate import is_our_host, is_our_origin

HOST = "127.0.0.1"
MOST_CLIENTS = 16  # pages at a time; each gets everything, and keeps 2 MB here
# of any kind, also those that have not sent their request yet; a page opens a few
MOST_CONNECTIONS = 64
PATIENCE_S = 5.0  # s that a handshake may take
LARGEST_MESSAGE = 65536  # bytes from a page; a button or a camera takes some hundred

_log = logging.getLogger(__name__)
_log.addHandler(logging.NullHandler())  # nonsense of a client is not shown to the user

# (connection, request) to a response, or None to go on with the handshake
Answer = Callable[[Any, Any], Any]


@contextmanager
def gated(token: str = "") -> Iterator[None]:
    """Give the servers that viser opens inside the gate.

    token: first part of the path of every request; empty for any path.

    viser passes no options on to them, so that the function that opens them is replaced.
    """
    from websockets.asyncio import server

    serve: Any = server.serve
    gated: Any = _with_gate(serve, server.ServerConnection, token)
    server.serve = gated  # type: ignore[misc]
    try:
        yield
    finally:
        server.serve = serve  # type: ignore[misc]


def silence(loop: asyncio.AbstractEventLoop | None) -> None:
    """Keep tracebacks off stderr when tasks of viser's loop fail on nonsense of a client."""
    assert loop is not None, "viser has started"  # noqa: S101
    loop.set_exception_handler(
        lambda _, context: _log.debug("%s", context["message"], exc_info=context.get("exception"))
    )


def _with_gate(serve: Callable[..., Any], connection: type[Any], token: str) -> Callable[..., Any]:
    class Counted(connection):  # type: ignore[misc]
        """A connection for which another may have to go."""

        def connection_made(self, transport: asyncio.BaseTransport) -> None:
            """Accept it; of too many, close the one that has sent no request for longest."""
            super().connection_made(transport)
            held = [each for each in self.server.handlers if not each.transport.is_closing()]
            if len(held) > MOST_CONNECTIONS:
                next(each for each in held if each.request is None).transport.abort()

    def gated_serve(
        handler: Any, host: Any, port: Any, *, process_request: Answer, **options: Any
    ) -> Any:
        """Serve with the gate before every handshake and bounds on what a client may send."""
        ours = {
            "max_size": LARGEST_MESSAGE,
            "open_timeout": PATIENCE_S,
            "create_connection": Counted,
            "logger": _log,
        }
        return serve(
            handler,
            host,
            port,
            process_request=_admitting(process_request, token),
            **options | ours,
        )

    return gated_serve


def _admitting(process: Answer, token: str) -> Answer:
    def admit(connection: Any, request: Any) -> Any:
        """Return a refusal, or the server's own answer."""
        if not admits(request.headers.get_all("Host"), request.headers.get_all("Origin")):
            return connection.respond(403, "not for pages of other hosts\n")
        path = inside(request.path, token)
        if path is None:
            return connection.respond(403, "the program printed the whole address of this page\n")
        request.path = path
        if "Upgrade" in request.headers and len(connection.server.connections) >= MOST_CLIENTS:
            return connection.respond(503, "too many clients\n")
        try:
            return process(connection, request)
        except (OSError, ValueError):  # a name of thousands of characters
            return connection.respond(404, "not found\n")

    return admit


def inside(path: str, token: str) -> str | None:
    """Return the path behind the token, all of it without one; None when the token is not there."""
    if not token:
        return path
    first, _, rest = path.removeprefix("/").partition("/")
    first, query, parameters = first.partition("?")
    known = hmac.compare_digest(first.encode(errors="replace"), token.encode())
    return f"/{rest}{query}{parameters}" if known else None


def admits(hosts: list[str], origins: list[str]) -> bool:
    """Return whether all Host and Origin headers of a request name this machine.

    Programs send no Origin.
    """
    return all(map(is_our_host, hosts)) and all(map(is_our_origin, origins))
