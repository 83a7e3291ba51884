"""A door in front of a WebSocket server: lets in whoever is no web page, and web pages of known origin only.

A browser lets any page connect to any port of this machine, and tells the server only the page's
origin (RFC 6455, 10.2). A server that does not look at it can be put behind this gate, at an
address that nobody guesses.
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
_HERE = re.compile(r"https?://(localhost|127\.0\.0\.1|\[::1\])(:\d+)?")
_REFUSAL = b"HTTP/1.1 %s\r\nConnection: close\r\nContent-Length: 0\r\n\r\n"


class OriginGate:
    """Hands on connections to a server on this machine.

    origins: allowed beside pages of this machine itself (http or https, localhost, any port). A
    request without an Origin is from a program, not from a page. A client that does not read is not
    read for: nothing piles up here.
    """

    def __init__(self, server: tuple[str, int], origins: Collection[str]) -> None:
        self._server, self._origins = server, origins
        self._clients = 0

    async def open(self, listener: socket.socket) -> asyncio.Server:
        """Serve clients of a listening socket."""
        return await asyncio.start_server(self._client, sock=listener, limit=LARGEST_REQUEST)

    async def _client(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._clients += 1
        try:
            await self._admit(reader, writer)
        except (OSError, asyncio.IncompleteReadError, asyncio.LimitOverrunError, TimeoutError):
            pass  # one client's trouble is nobody else's
        finally:
            self._clients -= 1
            await _hang_up(writer)

    async def _admit(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        request = await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), PATIENCE_S)
        if self._clients > MOST_CLIENTS:
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
        return all(origin in self._origins or _HERE.fullmatch(origin) for origin in origins)

    async def _relay(
        self, request: bytes, reader: asyncio.StreamReader, writer: asyncio.StreamWriter
    ) -> None:
        """Both ways until either side ends."""
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
            await _hang_up(to_server)


def listen(host: str, port: int) -> socket.socket:
    """A TCP socket that listens; port 0 takes a free one.

    Raises InputError when it cannot be had.
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


async def _hang_up(writer: asyncio.StreamWriter) -> None:
    """Close; what a vanished client has not taken is dropped."""
    with suppress(OSError, TimeoutError):
        await asyncio.wait_for(writer.drain(), PATIENCE_S)
    writer.transport.abort()
