"""The views and the receiver of set points of a live run, by the command's options."""

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from ipaddress import AddressValueError, IPv4Address
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import InputError
from .text import say

if TYPE_CHECKING:
    from ..live import Drives, LiveSession
    from ..live.control import DriveFeedback
    from ..live.control.pose import Pose
    from ..scenario import Scenario

_HIGHEST_PORT = 65535
_EXAMPLE = "127.0.0.1:5600"  # of a receiver on this machine


@contextmanager
def followers(
    session: "LiveSession",
    scenario: "Scenario",
    view_port: int | None,
    foxglove_port: int | None,
    *,
    tell: bool,
) -> Iterator[None]:
    """Run the processes that follow the ring; each reports its address on stderr.

    Args:
        session: that has not been run yet.
        scenario: of the session.
        view_port: of the 3D view; None for no view.
        foxglove_port: of the server for Foxglove; None for no server.
        tell: report every change of state on stderr.
    """
    with ExitStack() as stack:
        _open_desk(session, stack, tell)
        if view_port is not None:
            from ..live.control import allowed_buttons
            from ..viewer import ViewerProcess

            press, allowed = session.buttons.press, allowed_buttons()
            viewer = ViewerProcess(
                session.ring, scenario.platform, press, allowed, port=view_port, title=scenario.name
            )
            stack.enter_context(viewer)
            session.helpers.add(
                lambda: viewer.alive, "the view has died: nobody can press its buttons", parks=True
            )
            say(f"view: {viewer.url}")
        if foxglove_port is not None:
            from ..live.output import FoxgloveProcess

            server = FoxgloveProcess(
                session.ring, foxglove_port, scenario.platform.head_S, session.started_ns
            )
            stack.callback(server.close)
            session.helpers.add(lambda: server.alive, "the server for Foxglove has died")
            say(f"foxglove: {server.url}")
        yield


def _open_desk(session: "LiveSession", stack: ExitStack, tell: bool) -> None:
    """Open the operator's desk; without a place for its socket it has stdin only."""
    from ..live.output import OperatorDesk
    from ..telemetry.command_socket import open_socket

    listener = None
    try:
        place, listener = open_socket(os.getpid())
        stack.callback(lambda: place.unlink(missing_ok=True))
        say(f"operate: atlas-cueing operate {os.getpid()} engage|hold|park|reset|stop, or type it")
    except InputError as error:
        say(str(error))
    desk = OperatorDesk(session.ring, session.buttons.press, listener, announce=tell)
    stack.callback(desk.close)
    session.helpers.add(lambda: desk.alive, "the operator's desk has died: no commands but signals")


@contextmanager
def drives(
    setpoints: str | None, key_file: Path | None, scenario: "Scenario", *, listen: bool
) -> Iterator[tuple[Sequence["Drives"], "DriveFeedback | None"]]:
    """Open the sender of set points to HOST:PORT, or none when `setpoints` is None.

    Yield what takes the commands, and where the drives' words come from: None unless `listen`.

    Raises InputError for an address or a key that cannot be used.
    """
    if setpoints is None:
        if key_file is not None:
            raise InputError("--key is for --setpoints HOST:PORT, which is missing")
        if not listen:
            raise InputError("--no-drive-status is for --setpoints HOST:PORT, which is missing")
        yield (), None
        return
    from ..live.input.shared_key import read_key
    from ..live.output import SetPointSender, limits_hash

    host, port = _address(setpoints)
    key = read_key(key_file, f"--key {key_file}") if key_file else b""
    platform = scenario.platform
    limits = limits_hash(platform.wheel_limit_values(), platform.stage_limit_values())
    with closing(SetPointSender(host, port, key, limits if listen else b"")) as sender:
        yield (sender,), sender if listen else None
    if sender.unsent:
        say(f"{sender.unsent} set points could not be sent to {setpoints}")


def start(
    setpoints: str | None, file: Path | None, stated: str | None, scenario: "Scenario"
) -> tuple["Pose", Path | None]:
    """Return the pose to start from, and the file to keep it in: None without set points.

    Raises InputError when the platform is not known to be at home and nothing is stated.
    """
    from ..live.control.pose import Pose
    from ..live.start_pose import default_pose_file, start_pose

    if setpoints is None:
        if file is not None or stated is not None:
            raise InputError(
                f"{'--pose' if stated is None else '--from'} is for --setpoints HOST:PORT, which"
                " is missing"
            )
        return Pose(), None
    file = file or default_pose_file()
    pose = start_pose(stated, file, scenario.platform)
    if not pose.is_home:
        say(f"starts stopped, {pose}; a reset brings it slowly home")
    return pose, file


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
