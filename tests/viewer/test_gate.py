"""Hostile clients of a view: none gets in or takes more than its share, and the page stays."""

import gc
import socket
import struct
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import msgspec
import pytest
from waiting import until
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection

from atlas_cueing.viewer import gate
from atlas_cueing.viewer.gate import LARGEST_MESSAGE, MOST_CLIENTS, MOST_CONNECTIONS, admits
from atlas_cueing.viewer.server import close_server, open_server

from .gate_clients import OUTSIDE, SPEAKS, answer_to, joined, moved, page, update

HANDSHAKE = (
    "GET / HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection:"
    " Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version:"
    f" 13\r\nSec-WebSocket-Protocol: {SPEAKS}\r\n"
)


def read_on(client: ClientConnection) -> None:
    """Until the server hangs up."""
    while True:
        client.recv(timeout=20.0)


@contextmanager
def many(server: Any, count: int, begin: Callable[[Any], Any]) -> Iterator[list[Any]]:
    with ExitStack() as stack:
        yield [stack.enter_context(begin(server)) for _ in range(count)]


@pytest.mark.parametrize(
    "path",
    [
        *(
            OUTSIDE,
            OUTSIDE.replace("..", "%2e%2e"),
            OUTSIDE.replace("/..", "%2f.."),
            OUTSIDE.replace("/", "\\"),
            "//etc/passwd",
        ),
        *(f"/assets/..{OUTSIDE}", "http://x/etc/passwd", "/%00", "/" + "a" * 5000),
    ],
    ids=lambda path: path[:30],
)
def test_no_file_but_the_page(server: Any, path: str) -> None:
    answer = answer_to(server, f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".encode())
    assert answer.startswith(b"HTTP/1.1 404")
    assert b"root:" not in answer


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1.evil.example:8080", "[", "user@evil.example"]
)
def test_under_another_name_nothing_is_served(server: Any, host: str) -> None:
    """A page whose name was made to point here is of the same origin as what it asks for."""
    assert answer_to(server, f"GET / HTTP/1.1\r\nHost: {host}\r\n\r\n".encode()).startswith(
        b"HTTP/1.1 403"
    )
    assert answer_to(server, (HANDSHAKE.format(host=host) + "\r\n").encode()).startswith(
        b"HTTP/1.1 403"
    )


def test_what_a_page_of_another_host_sends_is_not_read(server: Any) -> None:
    """Not even what comes right behind its handshake, before it can be shut out."""
    theirs, ours = (server.gui.add_slider(name, 0.0, 1.0, 0.1, 0.5) for name in ("theirs", "ours"))
    move = moved(theirs, 0.9)
    frame = bytes([0x82, 0x80 | 126]) + struct.pack(">H", len(move)) + bytes(4) + move
    evil = HANDSHAKE.format(host="127.0.0.1") + "Origin: http://evil.example\r\n\r\n"
    assert answer_to(server, evil.encode() + 3 * frame).startswith(b"HTTP/1.1 403")
    with joined(server) as page_of_ours:
        page_of_ours.send(moved(ours, 0.9))
        until(lambda: ours.value == 0.9)
    assert theirs.value == 0.5


def foreign_records(caplog: pytest.LogCaptureFixture) -> list[str]:
    """Return what would have come to stderr: records of all logs but the program's own."""
    gc.collect()  # asyncio tells of a task that failed when it is dropped
    return [record.name for record in caplog.records if not record.name.startswith("atlas_cueing")]


@pytest.mark.parametrize(
    "nonsense",
    [
        b"",
        b"\xff" * 100,
        "text",
        msgspec.msgpack.encode([1]),
        msgspec.msgpack.encode({"type": "x"}),
        b"\x91" * 10_000,
    ],
    ids=["empty", "bytes", "text", "list", "unknown", "deep"],
)
def test_nonsense_ends_its_connection_and_nothing_else(
    server: Any,
    caplog: pytest.LogCaptureFixture,
    capfd: pytest.CaptureFixture[str],
    nonsense: bytes,
) -> None:
    with joined(server) as ours:
        ours.send(nonsense)
        with pytest.raises(ConnectionClosed):
            read_on(ours)
    assert page(server) == 200
    assert capfd.readouterr() == ("", "")
    assert not foreign_records(caplog)


@pytest.mark.parametrize("updates", [{"nope": 1}, {"value": "x"}, {"value": None}])
def test_nonsense_for_a_slider_is_dropped_in_silence(
    server: Any,
    caplog: pytest.LogCaptureFixture,
    capfd: pytest.CaptureFixture[str],
    updates: object,
) -> None:
    slider, other = (server.gui.add_slider(name, 0.0, 1.0, 0.1, 0.5) for name in ("one", "other"))
    with joined(server) as ours:
        ours.send(update(slider, updates))
        ours.send(moved(other, 0.9))
        until(lambda: other.value == 0.9)
    assert slider.value == 0.5
    assert page(server) == 200
    assert capfd.readouterr() == ("", "")
    assert not foreign_records(caplog)


def test_a_message_larger_than_any_is_not_kept(server: Any) -> None:
    with joined(server) as ours:
        ours.send(bytes(LARGEST_MESSAGE + 1))
        with pytest.raises(ConnectionClosed) as closed:
            read_on(ours)
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 1009


def test_there_are_not_ever_more_clients(server: Any) -> None:
    with many(server, MOST_CLIENTS, joined) as clients:
        with pytest.raises(InvalidStatus, match="HTTP 503"):
            joined(server)
        assert page(server) == 200, "which tells why"
        clients[0].close()
        until(lambda: _let_in(server))


def _let_in(server: Any) -> bool:
    try:
        joined(server).close()
    except InvalidStatus:
        return False
    return True


def half_a_request(server: Any) -> socket.socket:
    client = socket.create_connection(("127.0.0.1", server.get_port()), timeout=20.0)
    client.sendall(b"GET / HT")
    return client


@contextmanager
def patient(monkeypatch: pytest.MonkeyPatch, seconds: float) -> Iterator[Any]:
    monkeypatch.setattr(gate, "PATIENCE_S", seconds)
    served = open_server(0)
    try:
        yield served
    finally:
        close_server(served)


def test_of_connections_that_never_ask_the_oldest_make_room(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with (
        patient(monkeypatch, 600.0) as server,
        many(server, MOST_CONNECTIONS + 20, half_a_request) as clients,
    ):
        until(lambda: all(map(_hung_up, clients[:20])))
        assert page(server) == 200
        assert not any(map(_hung_up, clients[21:]))


def test_connections_that_never_ask_do_not_stay(monkeypatch: pytest.MonkeyPatch) -> None:
    with patient(monkeypatch, 0.1) as server, many(server, 3, half_a_request) as clients:
        until(lambda: all(map(_hung_up, clients)))


def _hung_up(client: socket.socket) -> bool:
    client.setblocking(False)
    try:
        return client.recv(1, socket.MSG_PEEK) == b""
    except BlockingIOError:
        return False
    except OSError:
        return True


@pytest.mark.parametrize(
    ("hosts", "origins", "right"),
    [
        (["127.0.0.1:8080"], [], True),
        (["localhost"], ["http://localhost:1"], True),
        (["[::1]:8080"], ["https://[::1]"], True),
        ([], [], True),
        (["LOCALHOST"], ["HTTP://LOCALHOST"], True),
        (["localhost", "evil.example"], [], False),
        (["localhost"], ["http://localhost", "http://evil.example"], False),
        (["localhost"], [""], False),
        ([""], [], False),
        (["localhost@evil.example"], [], False),
        (["localhost"], ["http://localhost.evil.example"], False),
        (["localhost"], ["http://[localhost"], False),
    ],
)
def test_names_of_this_machine(hosts: list[str], origins: list[str], right: bool) -> None:
    assert admits(hosts, origins) == right


def test_viser_has_its_own_server_again() -> None:
    from websockets.asyncio import server as websockets_server

    before = websockets_server.serve
    with gate.gated():
        assert websockets_server.serve is not before
    assert websockets_server.serve is before
