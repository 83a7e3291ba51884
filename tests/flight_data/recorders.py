"""Files as others write them: bags by rosbags, ULog and DataFlash by their published formats."""

import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .truth import Truth, flu, q_enu_flu

T0_NS = 1_700_000_000_123_456_789


def ros_bag(
    path: Path, flown: Truth, storage: str, *, odometry: bool = False, oriented: bool = True
) -> Path:
    """A ROS 2 bag with sensor_msgs/Imu, and nav_msgs/Odometry at every second sample."""
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    types: dict[str, Any] = store.types
    vector, turn = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"]
    header, stamp = types["std_msgs/msg/Header"], types["builtin_interfaces/msg/Time"]
    f, w, q = flu(flown.f_B), flu(flown.w_B), q_enu_flu(flown)
    known, unknown = np.zeros(9), np.array([-1.0, *[0.0] * 8])
    times = [T0_NS + round(t * 1e9) for t in flown.time.tolist()]
    with Writer(path, version=9, storage_plugin=StoragePlugin[storage]) as writer:
        imu = writer.add_connection("/imu/data", "sensor_msgs/msg/Imu", typestore=store)
        pose = writer.add_connection("/odom", "nav_msgs/msg/Odometry", typestore=store)
        for k, time in enumerate(times):
            head = header(stamp(time // 10**9, time % 10**9), "base_link")
            facing = turn(*(q[k] if oriented else (0.0, 0.0, 0.0, 1.0)))
            message = types["sensor_msgs/msg/Imu"](
                head,
                facing,
                known if oriented else unknown,
                vector(*w[k]),
                known,
                vector(*f[k]),
                known,
            )
            raw = store.serialize_cdr(message, "sensor_msgs/msg/Imu")
            writer.write(imu, time + 1_000_000, raw)
            if odometry and k % 2 == 0:
                writer.write(pose, time + 1_500_000, _odometry(store, types, head, turn(*q[k])))
    return path


def _odometry(store: Any, types: dict[str, Any], head: Any, facing: Any) -> bytes:
    zero = types["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
    pose = types["geometry_msgs/msg/Pose"](types["geometry_msgs/msg/Point"](0.0, 0.0, 0.0), facing)
    message = types["nav_msgs/msg/Odometry"](
        head,
        "base_link",
        types["geometry_msgs/msg/PoseWithCovariance"](pose, np.zeros(36)),
        types["geometry_msgs/msg/TwistWithCovariance"](
            types["geometry_msgs/msg/Twist"](zero, zero), np.zeros(36)
        ),
    )
    return bytes(store.serialize_cdr(message, "nav_msgs/msg/Odometry"))


def ulog(path: Path, flown: Truth) -> Path:
    """A ULog by its format (https://docs.px4.io/main/en/dev_log/ulog_file_format.html)."""

    def message(kind: str, body: bytes) -> bytes:
        return struct.pack("<HB", len(body), ord(kind)) + body

    out = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 5_000_000)
    out += message("B", bytes(40))
    for text in (
        "sensor_combined:uint64_t timestamp;double[3] gyro_rad;double[3] accelerometer_m_s2;",
        "vehicle_attitude:uint64_t timestamp;double[4] q;",
    ):
        out += message("F", text.encode())
    for number, name in enumerate((b"sensor_combined", b"vehicle_attitude")):
        out += message("A", struct.pack("<BH", 0, number) + name)
    parts = [out]
    for k, t in enumerate(flown.time.tolist()):
        stamp = 5_000_000 + round(t * 1e6)
        imu = struct.pack("<HQ6d", 0, stamp, *flown.w_B[k], *flown.f_B[k])
        parts.append(message("D", imu))
        parts.append(message("D", struct.pack("<HQ4d", 1, stamp, *flown.q_NB[k])))
    path.write_bytes(b"".join(parts))
    return path


_LENGTHS = {"Q": 8, "d": 8, "B": 1}


def dataflash(path: Path, flown: Truth, *, sensors: Sequence[int] = (0,)) -> Path:
    """A binary DataFlash log (https://ardupilot.org/dev/docs/code-overview-adding-a-new-log-message.html).

    Every message begins with a3 95 and its number; message 128 (FMT) describes the others.
    """
    head = b"\xa3\x95"
    kinds = {
        128: ("FMT", 89, "BBnNZ", "Type,Length,Name,Format,Columns"),
        130: ("IMU", 0, "QBdddddd", "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ"),
        131: ("ATT", 0, "Qddd", "TimeUS,Roll,Pitch,Yaw"),
    }
    parts = []
    for number, (name, length, form, columns) in kinds.items():
        size = length or 3 + sum(_LENGTHS[letter] for letter in form)
        texts = [
            text.encode().ljust(n, b"\0") for text, n in ((name, 4), (form, 16), (columns, 64))
        ]
        parts.append(head + struct.pack("<BBB", 128, number, size) + b"".join(texts))
    angles = np.degrees(flown.angles)
    for k, t in enumerate(flown.time.tolist()):
        stamp = 70_000_000 + round(t * 1e6)
        for sensor in sensors:
            imu = struct.pack("<BQB6d", 130, stamp, sensor, *flown.w_B[k], *(flown.f_B[k] + sensor))
            parts.append(head + imu)
        parts.append(head + struct.pack("<BQ3d", 131, stamp, *angles[k]))
    path.write_bytes(b"".join(parts))
    return path


def dataflash_text(path: Path, flown: Truth) -> Path:
    """A DataFlash log as text."""
    lines = [
        "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns",
        "FMT, 130, 60, IMU, QBdddddd, TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ",
        "FMT, 131, 35, ATT, Qddd, TimeUS,Roll,Pitch,Yaw",
    ]
    angles = np.degrees(flown.angles)
    for k, t in enumerate(flown.time.tolist()):
        stamp = 70_000_000 + round(t * 1e6)
        rates = ", ".join(repr(x) for x in (*flown.w_B[k].tolist(), *flown.f_B[k].tolist()))
        lines.append(f"IMU, {stamp}, 0, {rates}")
        lines.append(f"ATT, {stamp}, {', '.join(repr(x) for x in angles[k].tolist())}")
    path.write_text("\n".join(lines) + "\n")
    return path
