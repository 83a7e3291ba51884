"""The gate: which pages it lets in, and that it hands on bytes as they are."""

import asyncio
import socket
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from threading import Event

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.errors import InputError
from atlas_cueing.telemetry.origin_gate import LARGEST_REQUEST, MOST_CLIENTS, OriginGate, listen

GATE = OriginGate(("127.0.0.1", 1), ("https://app.example.org", "file://"))
REQUEST = b"GET / HTTP/1.1\r\nHost: 127.0.0.1:8765\r\nUpgrade: websocket\r\n\r\n"


def asking(*origins: str, name: str = "Origin") -> bytes:
    head = b"".join(f"{name}: {origin}\r\n".encode("latin-1") for origin in origins)
    return b"GET / HTTP/1.1\r\nHost: x\r\n" + head + b"\r\n"


class TestWhoIsAdmitted:
    @pytest.mark.parametrize(
        "origin",
        [
            "https://app.example.org",
            "file://",
            "http://localhost",
            "http://localhost:8080",
            "https://127.0.0.1:1",
            "http://[::1]:99",
        ],
    )
    def test_known_pages_and_those_of_this_machine(self, origin: str) -> None:
        assert GATE.admits(asking(origin))
        assert GATE.admits(asking(origin, name="ORIGIN"))

    def test_programs_send_no_origin(self) -> None:
        assert GATE.admits(asking())

    @pytest.mark.parametrize(
        "origin",
        [
            *(
                "https://evil.example",
                "null",
                "",
                "https://app.example.org.evil.example",
                "https://app.example.org:81",
            ),
            *(
                "http://app.example.org",
                "http://localhost.evil.example",
                "http://localhost@evil.example",
                "http://127.0.0.1x",
            ),
            *(
                "http://127.0.0.1:80:80",
                "http://127a0b0c1",
                "http://localhost:",
                "file://x",
                "http://localhost/x",
            ),
        ],
    )
    def test_no_other_page(self, origin: str) -> None:
        assert not GATE.admits(asking(origin))
        assert not GATE.admits(asking(origin, name="oRiGiN"))

    def test_one_bad_origin_among_good_ones_is_enough(self) -> None:
        assert not GATE.admits(asking("http://localhost", "https://evil.example"))
        assert not GATE.admits(asking("https://evil.example", "http://localhost"))

    @given(st.binary(max_size=200))
    def test_any_bytes_are_judged(self, data: bytes) -> None:
        assert GATE.admits(data + b"\r\n\r\n") in (True, False)


class TestTheRelay:
    def test_bytes_pass_both_ways_as_they_are(self) -> None:
        async def talk(port: int) -> None:
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            more = bytes(range(256)) * 1000
            writer.write(REQUEST + more)
            assert await reader.readexactly(len(REQUEST) + len(more)) == REQUEST + more
            writer.close()

        gated(talk)

    def test_a_refused_page_never_reaches_the_server(self) -> None:
        async def talk(port: int) -> None:
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            writer.write(asking("https://evil.example"))
            assert (await reader.read()).startswith(b"HTTP/1.1 403 Origin not allowed\r\n")
            writer.close()

        assert gated(talk) == 0

    def test_an_endless_head_is_hung_up_on(self) -> None:
        async def talk(port: int) -> None:
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            writer.write(b"GET / HTTP/1.1\r\nX: " + bytes(2 * LARGEST_REQUEST))
            with suppress(ConnectionResetError):
                assert await reader.read() == b""
            writer.close()

        assert gated(talk) == 0

    def test_who_says_nothing_is_hung_up_on(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr("atlas_cueing.telemetry.origin_gate.PATIENCE_S", 0.05)

        async def talk(port: int) -> None:
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            writer.write(b"GET / HTTP/1.1\r\n")
            with suppress(ConnectionResetError):
                assert await reader.read() == b""
            writer.close()

        assert gated(talk) == 0

    def test_there_are_not_ever_more_clients(self) -> None:
        async def talk(port: int) -> None:
            clients = [
                await asyncio.open_connection("127.0.0.1", port) for _ in range(MOST_CLIENTS)
            ]
            for reader, writer in clients:
                writer.write(REQUEST)
                await reader.readexactly(len(REQUEST))
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            writer.write(REQUEST)
            assert (await reader.read()).startswith(b"HTTP/1.1 503 Too many clients\r\n")
            for _, each in [*clients, (reader, writer)]:
                each.close()

        assert gated(talk) == MOST_CLIENTS

    def test_a_client_that_goes_makes_room(self) -> None:
        async def talk(port: int) -> None:
            for _ in range(3 * MOST_CLIENTS):
                reader, writer = await asyncio.open_connection("127.0.0.1", port)
                writer.write(REQUEST)
                await reader.readexactly(len(REQUEST))
                writer.transport.abort()
                await asyncio.sleep(0.001)

        assert gated(talk) == 3 * MOST_CLIENTS


def test_finish_waits_until_clients_have_the_last_bytes() -> None:
    """More bytes than any buffer takes, from a server that closes as soon as they are sent."""
    everything = bytes(64 * 2**20)

    async def send_all(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await reader.readuntil(b"\r\n\r\n")
        writer.write(everything)
        writer.close()

    async def run(listener: socket.socket, connected: Event) -> None:
        server = await asyncio.start_server(send_all, "127.0.0.1", 0)
        gate = OriginGate(server.sockets[0].getsockname(), ())
        door = await gate.open(listener)
        while not connected.is_set():
            await asyncio.sleep(0.001)
        door.close()
        server.close()
        await gate.finish(20.0)

    def read_all(port: int, connected: Event) -> int:
        with socket.create_connection(("127.0.0.1", port), timeout=20.0) as client:
            client.sendall(REQUEST)
            size = len(client.recv(1))
            connected.set()
            while piece := client.recv(2**20):
                size += len(piece)
        return size

    with listen("127.0.0.1", 0) as listener, ThreadPoolExecutor(1) as pool:
        connected = Event()
        size = pool.submit(read_all, listener.getsockname()[1], connected)
        asyncio.run(run(listener, connected))
        assert size.result(20.0) == len(everything)


class TestTheListener:
    def test_a_port_that_is_taken(self) -> None:
        with (
            listen("127.0.0.1", 0) as first,
            pytest.raises(InputError, match=r"TCP 127\.0\.0\.1:\d+: cannot listen there: .*in use"),
        ):
            listen("127.0.0.1", first.getsockname()[1])

    def test_a_port_that_is_none(self) -> None:
        with pytest.raises(InputError, match=r"TCP 127\.0\.0\.1:70000: cannot listen there"):
            listen("127.0.0.1", 70000)


def gated(talk: Callable[[int], Awaitable[None]]) -> int:
    """Talk to a server that echoes, through a gate; how many connections the server saw."""
    seen = 0

    async def echo(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        nonlocal seen
        seen += 1
        try:
            while data := await reader.read(65536):
                writer.write(data)
                await writer.drain()
        except OSError:
            pass
        finally:
            writer.close()

    async def run() -> None:
        server = await asyncio.start_server(echo, "127.0.0.1", 0)
        listener: socket.socket = listen("127.0.0.1", 0)
        gate = await OriginGate(server.sockets[0].getsockname(), ()).open(listener)
        async with server, gate:
            await asyncio.wait_for(talk(listener.getsockname()[1]), 20.0)

    asyncio.run(run())
    return seen
