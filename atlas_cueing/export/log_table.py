"""The topics of a log as columns over one time base: the ticks.

Every topic of numbers has a message at each tick. Where one lacks some, as in a log that was cut
or written by somebody else, its columns are NaN there. `/status` tells changes only: a row has the
state that holds at its time. `/tf` shows the pose of `/motion` to viewers and is left out.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, LogError
from ..recording import Log, TopicColumns
from ..rotations import Array
from ..signals import ALL_TOPICS, StateChange

TIME = "time_s"
STATUS = "/status"
_UNITS = {  # by the end of a field, the longer ends first
    "_rad_s2": "rad/s^2",
    "_rad_s": "rad/s",
    "_m_s2": "m/s^2",
    "_m_s": "m/s",
    "_n_m": "N m",
    "_rad": "rad",
    "_n": "N",
    "_m": "m",
    "_s": "s",
    "_w": "W",
}
_QUATERNION = re.compile(r"[a-z]+_([a-z])([a-z])_[wxyz]")
_VECTOR = re.compile(r"([a-z]+)[xyz](_\w+)?")


@dataclass(frozen=True, slots=True)
class Column:
    """A field of a topic over all ticks.

    topic: without its slash. unit: "1" for none. frame: axes of a vector ("B"), or what a
    quaternion turns ("S to W"); empty for neither. values: (n,), NaN where there is no message.
    """

    topic: str
    field: str
    unit: str
    frame: str
    values: Array

    @property
    def name(self) -> str:
        """Topic and field: `vehicle.wx_rad_s`."""
        return f"{self.topic}.{self.field}"


@dataclass(frozen=True, slots=True)
class LogTable:
    """Columns of a log over `time` (n,), s. statuses: changes of state, if they are asked for."""

    time: Array
    columns: tuple[Column, ...]
    statuses: tuple[StateChange, ...]
    metadata: dict[str, str]

    @property
    def topics(self) -> tuple[str, ...]:
        """Names of the topics, without slash."""
        return tuple(dict.fromkeys(column.topic for column in self.columns))

    def states(self) -> NDArray[np.str_]:
        """Return the state (n,) that holds at each time; "" before the first change."""
        changes = sorted(self.statuses, key=lambda change: change.time)
        names = np.array(["", *(change.state for change in changes)])
        times = np.array([change.time for change in changes])
        held: NDArray[np.str_] = names[np.searchsorted(times, self.time, side="right")]
        return held


def log_table(log: Log, topics: Sequence[str] = ()) -> LogTable:
    """Return the topics of a log as columns over one time base.

    topics: by name, with or without slash; all by default.

    Raises InputError for a topic that the log does not have, and LogError where there is no tick,
    or where the times of a topic do not go on, so that it has no place in a table.
    """
    wanted = _wanted(log, topics)
    tables = {topic: log.tables[topic] for topic in wanted if topic != STATUS}
    time = _time(log.path, tables)
    columns = [column for topic, table in tables.items() for column in _columns(topic, table, time)]
    statuses = log.statuses if STATUS in wanted else ()
    return LogTable(time, tuple(columns), statuses, dict(log.metadata))


def _wanted(log: Log, topics: Iterable[str]) -> list[str]:
    """Names of the topics, in the order of the log."""
    known = [topic for topic, table in log.tables.items() if TIME in table.fields]
    known += [STATUS] if log.statuses else []
    asked = {f"/{topic.strip().strip('/')}" for topic in topics}
    for topic in sorted(asked - {*known}):
        hint = "shows the pose of /motion to viewers; " if topic == "/tf" else ""
        raise InputError(
            f"log {log.path}: --topics: {topic}: {hint}allowed: {', '.join(known) or 'nothing'}"
        )
    found = [topic for topic in known if not asked or topic in asked]
    if not {*found} - {STATUS}:
        raise InputError(
            f"log {log.path}: --topics: {', '.join(found) or 'nothing'} has no numbers, allowed:"
            f" one of {', '.join({*known} - {STATUS}) or 'none; the log has no topic'}"
        )
    return found


def _time(path: Path, tables: dict[str, TopicColumns]) -> Array:
    """Return the times (n,) at which any of the topics has a message."""
    times = {topic: _times(table) for topic, table in tables.items()}
    for topic, each in times.items():
        wrong = np.flatnonzero(~(np.diff(each) > 0.0))
        if len(wrong):
            k = int(wrong[0])
            raise LogError(
                f"log {path}: {topic}: time_s = {each[k + 1]:.9g} after {each[k]:.9g}, allowed:"
                " times that go on; leave it out with --topics"
            )
    first, *others = times.values()
    if all(np.array_equal(first, other) for other in others):
        common = first
    else:
        common = np.unique(np.concatenate([first, *others]))
    if not len(common):
        raise LogError(f"log {path}: no tick in {', '.join(tables)}, so nothing to export")
    return common


def _times(table: TopicColumns) -> Array:
    return table.values[:, table.fields.index(TIME)]


def _columns(topic: str, table: TopicColumns, time: Array) -> Iterable[Column]:
    rows = np.searchsorted(time, _times(table))
    whole = len(rows) == len(time)
    for k, field in enumerate(table.fields):
        if field == TIME:
            continue
        values = table.values[:, k]
        if not whole:
            values = np.full(len(time), np.nan)
            values[rows] = table.values[:, k]
        yield Column(topic.strip("/"), field, _unit(field), _frame(topic, field), values)


def _unit(field: str) -> str:
    if _QUATERNION.fullmatch(field):
        return "1"
    return next((unit for end, unit in _UNITS.items() if field.endswith(end)), "1")


def _frame(topic: str, field: str) -> str:
    """Axes of a field, as the table of topics has them."""
    if found := _QUATERNION.fullmatch(field):
        after, before = found[1].upper(), found[2].upper()
        return f"{before} to {after}"
    known = next((each for each in ALL_TOPICS if each.name == topic), None)
    vector = _VECTOR.fullmatch(field)
    if known is None or vector is None:
        return ""
    return dict(known.other_frames).get(vector[1], known.frame)
