"""Where a run with drives begins: at home, or from a pose that somebody has stated."""

import os
from pathlib import Path
from shlex import quote

from ..errors import InputError, LogError
from ..recording import read_log
from ..rotation import ZERO, Vec3
from ..scenario import Platform
from ..wheels import Wheels
from .control.certified_axis import six_axes
from .control.command import Command
from .control.pose import Pose, pose_after_stop
from .output.pose_file import read_pose

HOME = "home"
_NO_TICK = 1e-9  # s


def default_pose_file() -> Path:
    """Return $XDG_STATE_HOME/atlas_cueing/pose.json, or its place below HOME."""
    state = os.environ.get("XDG_STATE_HOME", "")
    folder = Path(state) if Path(state).is_absolute() else Path.home() / ".local" / "state"
    return folder / "atlas_cueing" / "pose.json"


def start_pose(stated: str | None, file: Path, platform: Platform) -> Pose:
    """Return the pose to start from.

    Args:
        stated: `home`, a file with a pose, or a log; None for what `file` says.
        file: with the last pose; no such file means home.
        platform: of the scenario.

    Raises InputError when nothing is stated and the last pose is not home, and for what is stated
    and cannot be read.
    """
    if stated == HOME:
        return Pose()
    if stated is not None:
        return _stated(Path(stated), platform)
    if not file.exists():
        return Pose()
    pose, moving = read_pose(file, platform.name)
    if moving:
        raise InputError(
            f"pose {file}: the last run was cut off while it moved, at {pose}; look where the"
            f" platform stands, then say --from {quote(str(file))}, --from LOG or --from home"
        )
    if not pose.is_home:
        raise InputError(
            f"pose {file}: the last run has left the platform {pose}; say"
            f" --from {quote(str(file))} to start there, stopped, and go home by a reset, or"
            " --from home if it has been brought home by hand"
        )
    return pose


def _stated(file: Path, platform: Platform) -> Pose:
    """Return the pose of a pose file or of the end of a log."""
    try:
        with file.open("rb") as opened:
            is_pose = opened.read(1) == b"{"
    except OSError as error:
        raise InputError(
            f"--from {file}: {error.strerror}; allowed: home, a file with a pose, or a log"
        ) from error
    return read_pose(file, platform.name)[0] if is_pose else _end_of_log(file, platform)


def _end_of_log(file: Path, platform: Platform) -> Pose:
    """Return where the platform of a log came to rest after its last tick."""
    try:
        log = read_log(file)
        motion, wheels = (
            dict(zip(log.tables[topic].fields, log.tables[topic].values[-1].tolist(), strict=True))
            for topic in ("/motion", "/wheels")
        )
    except (LogError, KeyError, IndexError) as error:
        raise InputError(f"--from {file}: no log with a motion: {error}") from error

    def three(table: dict[str, float], *fields: str) -> Vec3:
        """Return three fields of a message as a vector."""
        x, y, z = (table[field] for field in fields)
        return (x, y, z)

    speed = three(wheels, *(f"w{k}_rad_s" for k in "123"))
    acceleration = three(wheels, *(f"a{k}_rad_s2" for k in "123"))
    p, v, a = (
        three(motion, *(f"{letter}{c}_{unit}" for c in "xyz"))
        for letter, unit in (("p", "m"), ("v", "m_s"), ("a", "m_s2"))
    )
    q_WS = (motion["q_ws_w"], motion["q_ws_x"], motion["q_ws_y"], motion["q_ws_z"])
    command = Command(0.0, speed, acceleration, p, v, a, ZERO)
    axes = six_axes(_NO_TICK, platform.wheel_limit_values(), platform.stage_limit_values())
    return pose_after_stop(q_WS, command, axes, Wheels(platform.geometry()).sphere_from_wheels)
