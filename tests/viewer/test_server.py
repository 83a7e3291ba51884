"""Only this machine is served, and only its own pages may talk back."""

import sys
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import pytest
import viser
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from atlas_cueing.errors import InputError
from atlas_cueing.viewer.server import check_viser, close_server, open_server, url_of

SPEAKS = [Subprotocol(f"viser-v{viser.__version__}")]


def answer(server: Any, origin: Any) -> int:
    """Bytes of the first message that a page from `origin` is sent."""
    with connect(
        f"ws://127.0.0.1:{server.get_port()}", origin=origin, subprotocols=SPEAKS, proxy=None
    ) as socket:
        return len(socket.recv(timeout=20.0))


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "https://127.0.0.1.evil.example", "null", "file://"]
)
def test_a_page_of_another_host_is_shut_out(server: Any, origin: str) -> None:
    with pytest.raises(InvalidStatus, match="HTTP 403"):
        answer(server, origin)


def test_our_own_page_is_not(server: Any) -> None:
    port = server.get_port()
    for origin in (f"http://127.0.0.1:{port}", f"http://localhost:{port}", None):
        assert answer(server, origin) > 0


def test_it_listens_on_the_loopback_only(server: Any) -> None:
    listening = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    port = f"{server.get_port():04X}"
    assert [line[1] for line in listening if line[1].endswith(f":{port}") and line[3] == "0A"] == [
        f"0100007F:{port}"
    ]
    with urlopen(url_of(server), timeout=20.0) as page:  # noqa: S310 - our own
        assert page.status == 200


def test_nobody_gets_a_public_address(server: Any) -> None:
    assert server.request_share_url() is None
    assert server._share_tunnel is None


def test_a_port_in_use_is_told(server: Any) -> None:
    with pytest.raises(InputError, match=f"port {server.get_port()}: in use"):
        open_server(server.get_port())


def test_it_is_silent(capfd: pytest.CaptureFixture[str]) -> None:
    close_server(open_server(0, "title"))
    assert capfd.readouterr() == ("", "")


def test_without_viser_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "viser", None)
    with pytest.raises(InputError, match=r"pip install 'atlas_cueing\[live\]'"):
        check_viser("live")
