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
    from ..live.control import DriveFeedback
    from ..live.control.pose import Pose
    from ..scenario import Scenario

_HIGHEST_PORT = 65535
_EXAMPLE = "127.0.0.1:5600"  # of a receiver on this machine
_LARGEST_KEY = 4096  # bytes of its file; keys have 32 at most


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
    from ..live.output import SetPointSender, limits_hash

    host, port = _address(setpoints)
    key = _key(key_file) if key_file else b""
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


def _key(file: Path) -> bytes:
    try:
        with file.open("rb") as opened:  # perhaps the pipe of a password manager
            key = opened.read(_LARGEST_KEY + 1)
    except OSError as error:
        raise InputError(f"--key {file}: {error.strerror}") from error
    if len(key) > _LARGEST_KEY:
        raise InputError(f"--key {file}: too large, allowed: size <= {_LARGEST_KEY} bytes")
    if not key.strip():
        raise InputError(f"--key {file}: holds no key")
    return key.strip()
