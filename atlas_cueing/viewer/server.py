"""A viser server that only this machine can talk to: bound to the loopback, silent, and deaf to pages of other hosts.

The only place that starts viser.
"""

from contextlib import redirect_stdout
from importlib.util import find_spec
from io import StringIO
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from ..errors import InputError

if TYPE_CHECKING:
    from viser import ViserServer

HOST = "127.0.0.1"
_OURS = frozenset((HOST, "localhost", "::1"))
_POLICY_VIOLATION = 1008  # RFC 6455, section 7.4.1


def check_viser(extra: str) -> None:
    """Raise InputError, naming the extra to install, when viser is missing."""
    try:
        missing = find_spec("viser") is None
    except ValueError:  # what find_spec says of a module that was switched off
        missing = True
    if missing:
        raise InputError(f"3D views need viser; install it with: pip install 'atlas_cueing[{extra}]'")


def open_server(port: int, title: str | None = None) -> "ViserServer":
    """Serve an empty page at `port`, 0 for any free one. Raises InputError when the port is in use."""
    from viser import ViserServer

    with redirect_stdout(StringIO()):  # a banner
        server = ViserServer(host=HOST, port=port, label=title, verbose=False)
    if port not in (0, server.get_port()):  # viser takes the next one that is free
        close_server(server)
        raise InputError(f"port {port}: in use; choose another one, or 0 for any that is free")
    _refuse_other_hosts(server)
    server.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=False)
    return server


def close_server(server: "ViserServer") -> None:
    """Stop serving."""
    with redirect_stdout(StringIO()):  # word of the end
        server.stop()


def url_of(server: "ViserServer") -> str:
    """Where the page is."""
    return f"http://{HOST}:{server.get_port()}"


def _refuse_other_hosts(server: "ViserServer") -> None:
    """No page of another host may press our buttons, nor anybody ask for viser's public tunnel.

    Browsers let any page of the web connect to a WebSocket of the loopback, but tell where the page is from.
    """
    sockets: Any = server._websock_server

    async def check_origin(client: Any) -> None:
        connection = sockets._live_connections[client.client_id]
        origin = connection.request.headers.get("Origin")
        if origin is not None and urlsplit(origin).hostname not in _OURS:
            await connection.close(_POLICY_VIOLATION, "not a page of this machine")

    def refuse(verbose: bool = True) -> None:  # noqa: ARG001 - as viser calls it
        return None

    sockets._client_connect_cb.insert(0, check_origin)
    server.request_share_url = refuse  # type: ignore[method-assign]
