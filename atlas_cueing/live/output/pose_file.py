"""The file with the pose of the platform, which outlives every run.

It is JSON, one object:

    version           1
    platform          name of the platform
    written           when, ISO 8601, UTC
    moving            true while the pose is that of a moving platform, at most 0.1 s old
    q_ws              orientation of the cabin, w, x, y, z
    wheel_angle_rad   of each wheel, as the set points count them
    stage_m           position of the stage from the centre, x, y, z, frame W
"""

import json
from datetime import UTC, datetime
from math import hypot
from pathlib import Path
from typing import Any

from ...atomic_file import write_whole
from ...errors import InputError, OutputError
from ...rotation import Quat, Vec3, normalise
from ..control.pose import Pose

_VERSION = 1
_LARGEST = 10_000  # bytes
_UNIT = 1e-3  # a quaternion whose norm is off by more is no orientation


def write_pose(file: Path, pose: Pose, platform: str, *, moving: bool) -> None:
    """Write the file, whole or not at all. Raises OutputError when it cannot be written."""
    content = {
        "version": _VERSION,
        "platform": platform,
        "written": datetime.now(UTC).isoformat(timespec="milliseconds"),
        "moving": moving,
        "q_ws": pose.q_WS,
        "wheel_angle_rad": pose.wheel_angle,
        "stage_m": pose.p_WS_W,
    }
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        write_whole(file, json.dumps(content, indent=1) + "\n")
    except OSError as error:
        raise OutputError(f"pose {file}: {error.strerror or error}") from error


def read_pose(file: Path, platform: str) -> tuple[Pose, bool]:
    """Return the pose in a file, and whether the platform moved when it was written.

    Raises InputError for a file that cannot be read, holds no pose, or that of another platform.
    """
    try:
        with file.open("rb") as opened:
            content = json.loads(opened.read(_LARGEST))
        if content["version"] != _VERSION:
            raise ValueError(f"version = {content['version']!r}, allowed: {_VERSION}")
        w, x, y, z = _numbers(content, "q_ws", 4)
        angle, place = _vector(content, "wheel_angle_rad"), _vector(content, "stage_m")
        pose = Pose(_orientation((w, x, y, z)), angle, place)
        moving, name = bool(content["moving"]), str(content["platform"])
    except OSError as error:
        raise InputError(f"pose {file}: {error.strerror or error}") from error
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        what = f"key {error} is missing" if isinstance(error, KeyError) else error
        raise InputError(f"pose {file}: holds no pose: {what}") from error
    if name != platform:
        raise InputError(
            f"pose {file}: platform = {name!r}, allowed: {platform!r}, that of the scenario;"
            " another platform needs a file of its own: --pose FILE"
        )
    return pose, moving


def _vector(content: Any, key: str) -> Vec3:
    x, y, z = _numbers(content, key, 3)
    return (x, y, z)


def _numbers(content: Any, key: str, count: int) -> list[float]:
    """Return the finite numbers of a key. Raises ValueError for any other content."""
    values = content[key]
    good = isinstance(values, list) and len(values) == count
    if not (good and all(type(x) in (int, float) and abs(x) < 1e12 for x in values)):
        raise ValueError(f"{key}: allowed: {count} finite numbers")
    return [float(x) for x in values]


def _orientation(q: Quat) -> Quat:
    if not abs(hypot(*q) - 1.0) <= _UNIT:
        raise ValueError(f"q_ws: norm {hypot(*q):.6g}, allowed: 1")
    return normalise(q)
