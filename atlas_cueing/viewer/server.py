"""Opens viser servers that only this machine can reach: the only place that starts viser.

They are bound to the loopback, print nothing, and refuse pages of other hosts.
"""

from contextlib import redirect_stdout
from importlib.util import find_spec
from io import StringIO
from typing import TYPE_CHECKING

from ..errors import InputError, MissingExtraError
from ..printable import printable
from .gate import HOST, gated, silence

if TYPE_CHECKING:
    from viser import ViserServer


def check_viser(extra: str) -> None:
    """Raise MissingExtraError when viser, which comes with `extra`, is not installed."""
    try:
        missing = find_spec("viser") is None
    except ValueError:  # from find_spec for a module that was switched off
        missing = True
    if missing:
        raise MissingExtraError("a 3D view", "viser", extra)


def open_server(port: int, title: str | None = None, token: str = "") -> "ViserServer":
    """Serve an empty page at `port`, 0 for any free one; with a token nowhere but below /TOKEN.

    Raises InputError when the port is in use.
    """
    from viser import ViserServer

    with redirect_stdout(StringIO()), gated(token):  # a banner
        server = ViserServer(host=HOST, port=port, label=title and printable(title), verbose=False)
    if port not in (0, server.get_port()):  # viser takes the next one that is free
        close_server(server)
        raise InputError(f"port {port}: in use; choose another one, or 0 for any that is free")
    silence(server._websock_server._background_event_loop)
    _close_tunnel(server)
    server.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=False)
    return server


def close_server(server: "ViserServer") -> None:
    """Stop serving."""
    with redirect_stdout(StringIO()):  # a message of the end
        server.stop()


def url_of(server: "ViserServer") -> str:
    """Return the address of the page."""
    return f"http://{HOST}:{server.get_port()}"


def _close_tunnel(server: "ViserServer") -> None:
    """Refuse requests for a public address by way of viser's own host."""

    def refuse(verbose: bool = True) -> None:
        """Return no address; called as viser does."""

    server.request_share_url = refuse  # type: ignore[method-assign]
