"""Encodes `/tf` for viewers: foxglove.FrameTransforms base -> stage -> cabin in a fixed layout.

The stage is moved by p_WS_W and the cabin turned by q_WS. Field numbers are those of
`schemas.transforms_schema`. The varints of the time stamp are padded to five bytes, which every
decoder reads as the same numbers, so that all messages have one length.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import LogError
from ..rotations import Array
from .wire import HEAD, Records, Times, record_template, repeat

# fields of a message, as in /motion
POSE = ("px_m", "py_m", "pz_m", "q_ws_w", "q_ws_x", "q_ws_y", "q_ws_z")
RATE_HZ = 60.0  # what viewers draw; more would only fill the log
_NO_TURN = (1.0, 0.0, 0.0, 0.0)
_VARINT = 5  # bytes; holds seconds below 2^35 and nanoseconds below 2^30
_DOUBLE = [("tag", "u1"), ("value", "<f8")]


def transform_template(channel: int) -> Records:
    """Return a record of base -> stage -> cabin with everything constant in place; shape ()."""
    stage, cabin = _transform("base", "stage"), _transform("stage", "cabin")
    dtype = np.dtype(
        [*HEAD, ("stage", _dtype("base", "stage")), ("cabin", _dtype("stage", "cabin"))]
    )
    template: Records = (
        np.frombuffer(record_template(channel, stage + cabin), dtype).copy().reshape(())
    )
    template["stage"]["rotation"]["value"][3] = 1.0  # no turn: w is last in foxglove.Quaternion
    return template


def put_transforms(records: Records, times: Times, q_WS: Array, p_WS_W: Array) -> None:
    """Fill n records of `transform_template`.

    Args:
        records: (n,), written.
        times: log times (n,), ns.
        q_WS: orientation of the cabin (n, 4).
        p_WS_W: position of the stage in W (n, 3), m.
    """
    records["log_time"] = records["publish_time"] = times
    seconds, nanoseconds = (_varint(part) for part in np.divmod(times, np.uint64(1_000_000_000)))
    for part in ("stage", "cabin"):
        records[part]["seconds"], records[part]["nanoseconds"] = seconds, nanoseconds
    records["stage"]["translation"]["value"] = p_WS_W
    records["cabin"]["rotation"]["value"] = q_WS[:, [1, 2, 3, 0]]


def take_transforms(records: Records) -> Array | None:
    """Return POSE (n, 7) of n records of `transform_template`.

    It is None if anything else in them is not as the template has it.
    """
    expected = repeat(transform_template(0), len(records))
    for name in ("channel", "log_time", "publish_time"):
        expected[name] = records[name]
    for part in ("stage", "cabin"):
        for name in ("seconds", "nanoseconds"):
            expected[part][name] = records[part][name]
    expected["stage"]["translation"]["value"] = records["stage"]["translation"]["value"]
    expected["cabin"]["rotation"]["value"] = records["cabin"]["rotation"]["value"]
    if expected.tobytes() != records.tobytes():
        return None
    turn = records["cabin"]["rotation"]["value"]
    return np.hstack([records["stage"]["translation"]["value"], turn[:, [3, 0, 1, 2]]])


def pose_of(message: Any) -> tuple[float, ...] | None:
    """Return POSE of a decoded foxglove.FrameTransforms; None when it has other frames only.

    Raises LogError when the stage turns or the cabin moves in it, as in no log of this program.
    """
    found = {(each.parent_frame_id, each.child_frame_id): each for each in message.transforms}
    stage, cabin = found.get(("base", "stage")), found.get(("stage", "cabin"))
    if stage is None and cabin is None:
        return None
    if stage is None or cabin is None or _turn(stage) != _NO_TURN or any(_move(cabin)):
        raise LogError("a message of /tf is not base -> stage -> cabin as this program writes it")
    return (*_move(stage), *_turn(cabin))


def _move(transform: Any) -> tuple[float, ...]:
    return tuple(getattr(transform.translation, c) for c in "xyz")


def _turn(transform: Any) -> tuple[float, ...]:
    return tuple(getattr(transform.rotation, c) for c in "wxyz")


def _dtype(parent: str, child: str) -> np.dtype[np.void]:
    """Return the layout of `_transform`."""
    return np.dtype(
        [
            ("until_seconds", "u1", (5,)),
            ("seconds", "u1", (_VARINT,)),
            ("nanoseconds_tag", "u1"),
            ("nanoseconds", "u1", (_VARINT,)),
            ("frames", "u1", (4 + len(parent) + len(child),)),
            ("translation_tag", "u1", (2,)),
            ("translation", _DOUBLE, (3,)),
            ("rotation_tag", "u1", (2,)),
            ("rotation", _DOUBLE, (4,)),
        ]
    )


def _transform(parent: str, child: str) -> bytes:
    """Return an element of `transforms` on the wire, with zeros for stamp and motion."""
    stamp = b"\x08" + bytes(_VARINT) + b"\x10" + bytes(_VARINT)
    vector = b"".join(bytes((tag, *bytes(8))) for tag in (0x09, 0x11, 0x19))
    quaternion = vector + b"\x21" + bytes(8)
    parts = (
        (0x0A, stamp),
        (0x12, parent.encode()),
        (0x1A, child.encode()),
        (0x22, vector),
        (0x2A, quaternion),
    )
    body = b"".join(bytes((tag, len(part))) + part for tag, part in parts)
    return bytes((0x0A, len(body))) + body


def _varint(values: Times) -> NDArray[np.uint8]:
    """Return the varints (n, 5) of numbers below 2^35.

    They have seven bits a byte, the lowest first, with a flag on all but the last byte.
    """
    bits = values[:, None] >> np.arange(0, 7 * _VARINT, 7, dtype=np.uint64) & np.uint64(0x7F)
    bits[:, :-1] |= np.uint64(0x80)
    return bits.astype(np.uint8)
