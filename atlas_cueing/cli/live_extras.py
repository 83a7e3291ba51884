"""The views and the receiver of set points of a live run, by the command's options."""

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from ipaddress import AddressValueError, IPv4Address
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import InputError
from .text import say

if TYPE_CHECKING:
    from ..live import Drives, LiveSession
    from ..scenario import Scenario

_HIGHEST_PORT = 65535
_EXAMPLE = "127.0.0.1:5600"  # of a receiver on this machine


@contextmanager
def followers(
    session: "LiveSession", scenario: "Scenario", view_port: int | None, foxglove_port: int | None
) -> Iterator[None]:
    """Run the processes that follow the ring; each reports its address on stderr.

    Args:
        session: that has not been run yet.
        scenario: of the session.
        view_port: of the 3D view; None for no view.
        foxglove_port: of the server for Foxglove; None for no server.
    """
    with ExitStack() as stack:
        if view_port is not None:
            from ..live.control import allowed_buttons
            from ..viewer import ViewerProcess

            press, allowed = session.buttons.press, allowed_buttons()
            viewer = ViewerProcess(
                session.ring, scenario.platform, press, allowed, port=view_port, title=scenario.name
            )
            stack.enter_context(viewer)
            say(f"view: {viewer.url}")
        if foxglove_port is not None:
            from ..live.output import FoxgloveProcess

            server = FoxgloveProcess(
                session.ring, foxglove_port, scenario.platform.head_S, session.started_ns
            )
            stack.callback(server.close)
            say(f"foxglove: {server.url}")
        yield


@contextmanager
def drives(setpoints: str | None, key_file: Path | None) -> Iterator[Sequence["Drives"]]:
    """Open the sender of set points to HOST:PORT, or none when `setpoints` is None.

    Raises InputError for an address or a key that cannot be used.
    """
    if setpoints is None:
        if key_file is not None:
            raise InputError("--key is for --setpoints HOST:PORT, which is missing")
        yield ()
        return
    from ..live.input.shared_key import read_key
    from ..live.output import SetPointSender

    host, port = _address(setpoints)
    key = read_key(key_file, f"--key {key_file}") if key_file else b""
    with closing(SetPointSender(host, port, key=key)) as sender:
        yield (sender,)
    if sender.unsent:
        say(f"{sender.unsent} set points could not be sent to {setpoints}")


def _address(text: str) -> tuple[str, int]:
    host, colon, port = text.rpartition(":")
    wrong = "" if colon and host else "the port or the host is missing"
    if not wrong and not (port.isascii() and port.isdigit() and 1 <= int(port) <= _HIGHEST_PORT):
        wrong = f"port {port!r}, allowed: 1 to {_HIGHEST_PORT}"
    if not wrong and not _is_numeric(host):
        wrong = f"host {host!r}, allowed: a numeric IPv4 address, for names are not looked up"
    if wrong:
        raise InputError(f"--setpoints {text}: {wrong}; HOST:PORT is written as in {_EXAMPLE}")
    return host, int(port)


def _is_numeric(host: str) -> bool:
    try:
        IPv4Address(host)
    except AddressValueError:
        return False
    return True
