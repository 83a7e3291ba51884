"""Programs that speak to the server of a page."""

import http.client
import socket
from typing import Any

import msgspec
import viser
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

SPEAKS = f"viser-v{viser.__version__}"


OUTSIDE = "/../../../../../../../../etc/passwd"


def page(server: Any) -> int:
    """Status of the page, which everybody may ask for."""
    client = http.client.HTTPConnection("127.0.0.1", server.get_port(), timeout=20.0)
    try:
        client.request("GET", "/")
        return client.getresponse().status
    finally:
        client.close()


def joined(server: Any, path: str = "") -> ClientConnection:
    address = f"ws://127.0.0.1:{server.get_port()}{path}"
    return connect(
        address, subprotocols=[Subprotocol(SPEAKS)], proxy=None, open_timeout=20.0, max_size=None
    )


def answer_to(server: Any, request: bytes) -> bytes:
    """What comes back until the server hangs up."""
    with socket.create_connection(("127.0.0.1", server.get_port()), timeout=20.0) as client:
        client.sendall(request)
        answer = b""
        while piece := client.recv(65536):
            answer += piece
        return answer


def moved(slider: Any, to: object) -> bytes:
    """What a page sends when somebody moves a slider."""
    return update(slider, {"value": to})


def update(slider: Any, updates: object) -> bytes:
    return msgspec.msgpack.encode(
        {"type": "GuiUpdateMessage", "uuid": slider._impl.uuid, "updates": updates}
    )
