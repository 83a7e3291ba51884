"""ROS 2 bags, MCAP and SQLite, and ROS 1 bags; no ROS is needed (rosbags decodes them).

A table is a topic (`/imu/data`) or a type of message (`sensor_msgs/msg/Imu`), a column a path
through the message (`linear_acceleration.x`). `header.stamp` is the sender's time in ns, `received`
the recorder's.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import InputError, MissingExtraError
from ..flight_map import FlightMap
from ..samples import Part, Progress, Samples, Wanted, wanted

RECEIVED, STAMP = "received", "header.stamp"
_OFTEN = 2000  # messages between two reports
_NANO = 10**9


def read_ros_bag(path: Path, flight_map: FlightMap, progress: Progress) -> dict[Part, Samples]:
    """Read a bag, see `Reader`: a folder with metadata.yaml, or an .mcap, .db3 or .bag file."""
    try:
        from rosbags.highlevel import AnyReader, AnyReaderError
        from rosbags.typesys import Stores, get_typestore
    except ImportError as error:
        raise MissingExtraError("reading a ROS bag", "rosbags", "logs") from error
    try:
        store = get_typestore(Stores.ROS2_HUMBLE)
        with AnyReader([path], default_typestore=store) as reader:
            return _Bag(path, reader, flight_map, progress).parts()
    except InputError:
        raise
    except AnyReaderError as error:
        raise InputError(f"{path}: no ROS bag that can be read: {_line(error)}") from error
    except Exception as error:
        raise InputError(
            f"{path}: no ROS bag that can be read: {type(error).__name__}: {_line(error)}"
        ) from error


class _Bag:
    """An open bag, and what is wanted of it."""

    def __init__(self, path: Path, reader: Any, flight_map: FlightMap, progress: Progress) -> None:
        self._path, self._reader, self._progress = path, reader, progress
        self._time = flight_map.time.column[0]
        self._wanted = wanted(flight_map)

    def parts(self) -> dict[Part, Samples]:
        """Return the samples of each part; each message is decoded once."""
        of_topic: dict[str, list[Wanted]] = {}
        for part in self._wanted:
            topic = self._topic(part)
            if topic is not None:
                of_topic.setdefault(topic, []).append(part)
        chosen = [c for c in self._reader.connections if c.topic in of_topic]
        total = max(sum(c.msgcount for c in chosen), 1)
        found: dict[Part, list[tuple[int, int, list[float]]]] = {p.part: [] for p in self._wanted}
        counts = dict.fromkeys(of_topic, 0)
        for read, (connection, received, raw) in enumerate(self._reader.messages(chosen)):
            topic = connection.topic
            counts[topic] += 1
            message = self._decoded(connection, raw, counts[topic])
            place = f"{self._path}: message {counts[topic]} of {topic}"
            stamp = self._stamp(message, received, place)
            for part in of_topic[topic]:
                found[part.part].append((counts[topic], stamp, _values(message, part, place)))
            if read % _OFTEN == 0:
                self._progress(read / total)
        topics = {part.part: topic for topic, parts in of_topic.items() for part in parts}
        return {
            part.part: self._samples(topics[part.part], part, found[part.part])
            for part in self._wanted
            if part.part in topics and not _lacks(part, found[part.part])
        }

    def _topic(self, part: Wanted) -> str | None:
        """Return the one topic that is called so or has messages of this type."""
        all_of: dict[str, str] = {c.topic: c.msgtype for c in self._reader.connections}
        short = part.table.replace("/msg/", "/")
        fits = sorted(
            topic
            for topic, kind in all_of.items()
            if part.table == topic or short == kind.replace("/msg/", "/")
        )
        if part.optional and not fits:
            return None
        if len(fits) == 1:
            return fits[0]
        told = ", ".join(f"{topic} ({kind})" for topic, kind in sorted(all_of.items())) or "none"
        if not fits:
            raise InputError(
                f"{self._path}: no topic or type {part.table!r} ({part.part}.table of the map);"
                f" topics: {told}"
            )
        raise InputError(
            f"{self._path}: {len(fits)} topics of type {part.table!r}: {', '.join(fits)}; choose"
            f" one: --set {part.part}.table={fits[0]}"
        )

    def _decoded(self, connection: Any, raw: bytes, count: int) -> Any:
        try:
            return self._reader.deserialize(raw, connection.msgtype)
        except Exception as error:
            raise InputError(
                f"{self._path}: message {count} of {connection.topic}: cannot be decoded:"
                f" {_line(error)}"
            ) from error

    def _stamp(self, message: Any, received: int, place: str) -> int:
        """Return the time of a message, ns."""
        if self._time == RECEIVED:
            return received
        found = _attribute(message, self._time, place, "time.column")
        stamp = int(found.sec) * _NANO + int(found.nanosec) if hasattr(found, "sec") else int(found)
        if stamp == 0:
            raise InputError(
                f"{place}: {self._time} is 0; to take the time of the recorder: --set"
                f" time.column={RECEIVED}"
            )
        return stamp

    def _samples(
        self, topic: str, part: Wanted, rows: list[tuple[int, int, list[float]]]
    ) -> Samples:
        if not rows:
            raise InputError(f"{self._path}: topic {topic} ({part.part}) has no messages")
        return Samples(
            topic,
            "message",
            np.array([row for row, _, _ in rows]),
            np.array([stamp for _, stamp, _ in rows], dtype=np.int64),
            np.array([values for _, _, values in rows], dtype=np.float64),
            tuple(names[0] for names in part.columns),
            self._time,
        )


def _values(message: Any, part: Wanted, place: str) -> list[float]:
    """Return the numbers of a part; NaN for an orientation that its sender calls unknown."""
    covariance = getattr(message, "orientation_covariance", None)
    unknown = part.part == "attitude" and covariance is not None and covariance[0] == -1.0
    if unknown:
        return [float("nan")] * len(part.columns)
    key = f"{part.part}.columns"
    return [float(_attribute(message, names[0], place, key)) for names in part.columns]


def _lacks(part: Wanted, rows: Iterable[tuple[int, int, list[float]]]) -> bool:
    """Whether the file has none of an attitude that may be missing."""
    return part.optional and all(x != x or x == 0.0 for _, _, values in rows for x in values)


def _attribute(message: Any, path: str, place: str, key: str) -> Any:
    found = message
    for name in path.split("."):
        if not hasattr(found, name):
            known = ", ".join(n for n in getattr(found, "__dataclass_fields__", ()) if n[0] != "_")
            raise InputError(f"{place}: has no {path!r} ({key} of the map); fields: {known}")
        found = getattr(found, name)
    return found


def _line(error: Exception) -> str:
    return " ".join(str(error).split())[:300]
