"""A viser server that only this machine can talk to.

Bound to the loopback, silent, and deaf to pages of other hosts.

The only place that starts viser.
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
    except ValueError:  # what find_spec says of a module that was switched off
        missing = True
    if missing:
        raise MissingExtraError("a 3D view", "viser", extra)


def open_server(port: int, title: str | None = None) -> "ViserServer":
    """Serve an empty page at `port`, 0 for any free one.

    Raises InputError when the port is in use.
    """
    from viser import ViserServer

    with redirect_stdout(StringIO()), gated():  # a banner
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
    with redirect_stdout(StringIO()):  # word of the end
        server.stop()


def url_of(server: "ViserServer") -> str:
    """Where the page is."""
    return f"http://{HOST}:{server.get_port()}"


def _close_tunnel(server: "ViserServer") -> None:
    """Nobody may ask for viser's public address."""

    def refuse(verbose: bool = True) -> None:
        """No address; called as viser does."""

    server.request_share_url = refuse  # type: ignore[method-assign]
