"""The views and the receiver of set points of a live run, by the command's options."""

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
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


@dataclass(frozen=True, slots=True)
class DriveLink:
    """What was asked for of the drives.

    address: of their controller, HOST:PORT; None for no drives.
    key: file with a shared key.
    listen: they tell what they do.
    pose: file with the platform's last pose.
    stated: where the platform stands.
    plant: a simulated platform stands for the drives.
    """

    address: str | None = None
    key: Path | None = None
    listen: bool = True
    pose: Path | None = None
    stated: str | None = None
    plant: bool = False


@dataclass(frozen=True, slots=True)
class Pages:
    """Ports of the 3D view and of the server for Foxglove; None for none."""

    view: int | None = None
    foxglove: int | None = None


@contextmanager
def followers(
    session: "LiveSession", scenario: "Scenario", pages: Pages, *, tell: bool
) -> Iterator[Sequence[str]]:
    """Run the processes that follow the ring; yield where each can be reached, to be told.

    Args:
        session: that has not been run yet.
        scenario: of the session.
        pages: that are wanted.
        tell: report every change of state on stderr.
    """
    with ExitStack() as stack:
        lines = [_open_desk(session, stack, tell)]
        if pages.view is not None:
            lines.append(_open_view(session, scenario, pages.view, stack))
        if pages.foxglove is not None:
            lines.append(_open_foxglove(session, scenario, pages.foxglove, stack))
        yield lines


def _open_view(session: "LiveSession", scenario: "Scenario", port: int, stack: ExitStack) -> str:
    from ..live.control import allowed_buttons
    from ..viewer import ViewerProcess

    press, allowed = session.buttons.press, allowed_buttons()
    viewer = ViewerProcess(
        session.ring, scenario.platform, press, allowed, port=port, title=scenario.name
    )
    stack.enter_context(viewer)
    died = "the view has died, or answers no more: nobody can press its buttons"
    session.helpers.add(lambda: viewer.answers, died, parks=True)
    return f"view: {viewer.url}"


def _open_foxglove(
    session: "LiveSession", scenario: "Scenario", port: int, stack: ExitStack
) -> str:
    from ..live.output import FoxgloveProcess

    head_S = scenario.platform.head_S
    server = FoxgloveProcess(
        *(session.ring, port, head_S, session.started_ns), attitude=session.corrects
    )
    stack.callback(server.close)
    session.helpers.add(
        lambda: server.answers, "the server for Foxglove has died, or answers no more"
    )
    return f"foxglove: {server.url}"


def _open_desk(session: "LiveSession", stack: ExitStack, tell: bool) -> str:
    """Open the operator's desk; without a place for its socket it has stdin only."""
    from ..live.output import OperatorDesk
    from ..telemetry.command_socket import open_socket

    listener = None
    try:
        place, listener = open_socket(os.getpid())
        stack.callback(lambda: place.unlink(missing_ok=True))
        line = (
            f"operate: atlas-cueing operate {os.getpid()} engage|hold|park|reset|stop, or type it"
        )
    except InputError as error:
        line = str(error)
    desk = OperatorDesk(session.ring, session.buttons.press, listener, announce=tell)
    stack.callback(desk.close)
    died = "the operator's desk has died, or answers no more: no commands but signals"
    session.helpers.add(lambda: desk.answers, died)
    return line


@contextmanager
def drives(
    link: DriveLink, scenario: "Scenario"
) -> Iterator[tuple[Sequence["Drives"], "DriveFeedback | None"]]:
    """Open the sender of set points, or none without an address.

    Yield what takes the commands, and where the drives' words come from: None unless they tell.

    Raises InputError for an address or a key that cannot be used.
    """
    if link.address is None:
        _refuse_what_needs_drives(link)
        yield (), None
        return
    from ..live.input.shared_key import read_key
    from ..live.output import SetPointSender, limits_hash

    host, port = _address(link.address)
    key = read_key(link.key, f"--key {link.key}") if link.key else b""
    platform = scenario.platform
    limits = limits_hash(platform.wheel_limit_values(), platform.stage_limit_values())
    with closing(SetPointSender(host, port, key, limits if link.listen else b"")) as sender:
        yield (sender,), sender if link.listen else None
    if sender.unsent:
        say(f"{sender.unsent} set points could not be sent to {link.address}")


def _refuse_what_needs_drives(link: DriveLink) -> None:
    given = {
        "--key": link.key,
        "--no-drive-status": not link.listen,
        "--from": link.stated,
        "--pose": link.pose,
    }
    for option, value in given.items():
        if value:
            raise InputError(f"{option} is for --setpoints HOST:PORT, which is missing")


@contextmanager
def standing(link: DriveLink, scenario: "Scenario") -> Iterator[tuple["Pose", Path | None]]:
    """Yield the pose to start from, and the file to keep it in: None without drives.

    No other ride has the file meanwhile.

    Raises InputError when another ride has it, and when the platform is not known to be at home and
    nothing is stated.
    """
    from ..live.control.pose import Pose
    from ..live.pose_lock import locked_pose
    from ..live.start_pose import default_pose_file, start_pose

    if link.address is None:
        yield Pose(), None
        return
    file = link.pose or default_pose_file()
    with locked_pose(file):
        yield start_pose(link.stated, file, scenario.platform), file


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
