"""A gate in front of a WebSocket server: it lets in programs, and web pages of known origin only.

A browser lets any page connect to any port of this machine, and sends the server only the page's
origin (RFC 6455, 10.2). A server that does not look at it can be put behind this gate, at an
address that cannot be guessed.
"""

import asyncio
import re
import socket
from collections.abc import Collection
from contextlib import suppress

from ..errors import InputError

LARGEST_REQUEST = 8192  # bytes of a handshake
PATIENCE_S = 5.0  # s that a handshake may take
MOST_CLIENTS = 16
_PIECE = 65536  # bytes
_HOST = r"(localhost|127\.0\.0\.1|\[::1\])(:\d+)?"
_OUR_HOST = re.compile(_HOST, re.IGNORECASE)
_OUR_ORIGIN = re.compile(rf"https?://{_HOST}", re.IGNORECASE)
_REFUSAL = b"HTTP/1.1 %s\r\nConnection: close\r\nContent-Length: 0\r\n\r\n"


class OriginGate:
    """Relays connections to a server on this machine.

    A request without an Origin is from a program, not from a page. From the server no more is read
    than the client takes: nothing piles up here.
    """

    def __init__(self, server: tuple[str, int], origins: Collection[str]) -> None:
        """Prepare to relay to `server` (host and port).

        `origins` are allowed beside pages of this machine (http or https, localhost, any port).
        """
        self._server, self._origins = server, origins
        self._clients = set[asyncio.Task[object]]()

    async def open(self, listener: socket.socket) -> asyncio.Server:
        """Serve clients of a listening socket."""
        return await asyncio.start_server(self._client, sock=listener, limit=LARGEST_REQUEST)

    async def finish(self, timeout: float) -> None:
        """Wait until the server has closed all connections and clients have their last bytes.

        It takes at most `timeout` s.
        """
        if self._clients:
            await asyncio.wait(self._clients, timeout=timeout)

    async def _client(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None, "it runs in a task"  # noqa: S101
        self._clients.add(task)
        try:
            await self._admit(reader, writer)
        except (OSError, asyncio.IncompleteReadError, asyncio.LimitOverrunError, TimeoutError):
            pass  # one client's trouble does not concern the others
        finally:
            await _close(writer)
            self._clients.discard(task)

    async def _admit(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        request = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), PATIENCE_S)
        if len(self._clients) > MOST_CLIENTS:
            writer.write(_REFUSAL % b"503 Too many clients")
        elif not self.admits(request):
            writer.write(_REFUSAL % b"403 Origin not allowed")
        else:
            await self._relay(request, reader, writer)

    def admits(self, request: bytes) -> bool:
        """Whether the head of this HTTP request has no Origin, or one that is allowed."""
        lines = request.decode("latin-1").split("\r\n")[1:]
        origins = [
            line.partition(":")[2].strip()
            for line in lines
            if line.partition(":")[0].strip().lower() == "origin"
        ]
        return all(origin in self._origins or is_our_origin(origin) for origin in origins)

    async def _relay(
        self, request: bytes, reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        """Relay both ways until either side ends."""
        from_server, to_server = await asyncio.open_connection(*self._server)
        try:
            to_server.write(request)
            ways = [
                asyncio.create_task(_pump(reader, to_server)),
                asyncio.create_task(_pump(from_server, writer)),
            ]
            try:
                await asyncio.wait(ways, return_when=asyncio.FIRST_COMPLETED)
            finally:
                for way in ways:
                    way.cancel()
                await asyncio.gather(*ways, return_exceptions=True)
        finally:
            await _close(to_server)


def is_our_host(host: str) -> bool:
    """Return whether a Host header names this machine."""
    return _OUR_HOST.fullmatch(host) is not None


def is_our_origin(origin: str) -> bool:
    """Return whether an Origin header is that of a page of this machine, at any port."""
    return _OUR_ORIGIN.fullmatch(origin) is not None


def listen(host: str, port: int) -> socket.socket:
    """Return a TCP socket that listens at `host` and `port`; port 0 takes a free one.

    Raises InputError when the port is not available.
    """
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((host, port))
        listener.listen(MOST_CLIENTS)
    except (OSError, OverflowError) as error:
        listener.close()
        raise InputError(
            f"TCP {host}:{port}: cannot listen there: {error}; another program may have it"
        ) from error
    return listener


async def _pump(source: asyncio.StreamReader, sink: asyncio.StreamWriter) -> None:
    while data := await source.read(_PIECE):
        sink.write(data)
        await sink.drain()


async def _close(writer: asyncio.StreamWriter) -> None:
    """Close a connection after its last bytes; drop those that are not taken in time."""
    writer.close()
    with suppress(OSError, TimeoutError):
        await asyncio.wait_for(writer.wait_closed(), PATIENCE_S)
    writer.transport.abort()
