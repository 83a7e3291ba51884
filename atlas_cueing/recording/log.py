"""A log in memory: columns of doubles by topic and field."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import LogError, MissingExtraError
from ..rotations import Array
from ..signals import TOPICS, StateChange
from .wire import Times

if TYPE_CHECKING:
    from pandas import DataFrame

_COMPONENTS = ("wxyz", "xyz", "123")  # of a quaternion, a vector, the wheels


@dataclass(frozen=True, slots=True)
class TopicColumns:
    """All messages of a topic, in the order of the log.

    fields: names of the columns, the unit in the name.
    values: (n, fields).
    log_times: (n,), ns.
    """

    fields: tuple[str, ...]
    values: Array
    log_times: Times = field(default_factory=lambda: np.empty(0, np.uint64))


@dataclass(frozen=True, slots=True)
class Log:
    """A complete log of one run.

    tables: columns of each topic of doubles.
    metadata: the record `atlas.run`.
    attachments: files by name.
    statuses: changes of state, in order.
    transforms: columns of /tf: position of the stage and orientation of the cabin.
    notes: what in the file was not read or not checked, a line each.
    """

    path: Path
    tables: Mapping[str, TopicColumns]
    metadata: Mapping[str, str]
    attachments: Mapping[str, bytes]
    statuses: tuple[StateChange, ...]
    transforms: TopicColumns | None = None
    notes: tuple[str, ...] = ()

    @classmethod
    def of_ticks(cls, ticks: Array) -> "Log":
        """Make a log of ticks (n, fields of TOPICS) in memory, as `McapRecorder` observers get."""
        tables, start = {}, 0
        for topic in TOPICS:
            end = start + len(topic.fields)
            tables[topic.name], start = TopicColumns(topic.fields, ticks[:, start:end]), end
        return cls(Path(), tables, {}, {}, ())

    def column(self, topic: str, field: str) -> Array:
        """Return one field over the whole run, (n,), in the unit of its name.

        Raises LogError if the log does not have it.
        """
        table = self._table(topic)
        if field not in table.fields:
            raise LogError(
                f"{self.path}: {topic} has no field {field!r}; fields: {', '.join(table.fields)}"
            )
        return table.values[:, table.fields.index(field)]

    def columns(self, topic: str) -> dict[str, Array]:
        """Return all fields of a topic by name, (n,) each, in the units of their names.

        Raises LogError if the log does not have the topic.
        """
        table = self._table(topic)
        return dict(zip(table.fields, table.values.T, strict=True))

    def frame(self, topic: str) -> "DataFrame":
        """Return a topic as a pandas data frame: a column a field, indexed by time_s.

        Raises LogError if the log does not have the topic, and MissingExtraError without pandas.
        """
        try:
            from pandas import DataFrame
        except ImportError:
            raise MissingExtraError("Log.frame", "pandas", "pandas") from None
        return DataFrame(self.columns(topic)).set_index("time_s")

    def vector(self, topic: str, name: str) -> Array:
        """Return a vector or quaternion over the whole run.

        It has the fields that begin with `name` and an axis, component or wheel number: `q_ws`
        gives (n, 4); `w` gives (n, 3), in the frame and unit of the topic.

        Raises LogError if the log does not have it.
        """
        table = self._table(topic)
        pattern = re.compile(re.escape(name) + r"(?:_([wxyz])|([xyz123])_\w+)")
        found = {
            m[1] or m[2]: i
            for i, field in enumerate(table.fields)
            if (m := pattern.fullmatch(field))
        }
        components = next((c for c in _COMPONENTS if found.keys() == set(c)), "")
        if not components:
            raise LogError(
                f"{self.path}: {topic} has no vector {name!r}; fields: {', '.join(table.fields)}"
            )
        columns = [found[component] for component in components]
        start, end = columns[0], columns[-1] + 1
        # as a part of the table where they lie side by side, as in all logs of this program
        return table.values[:, slice(start, end) if columns == list(range(start, end)) else columns]

    def _table(self, topic: str) -> TopicColumns:
        if topic not in self.tables:
            raise LogError(
                f"{self.path}: the log has no topic {topic!r}; topics: {', '.join(self.tables)}"
            )
        return self.tables[topic]


class Growing:
    """A table that is not complete yet.

    Its memory grows in place, where lists of pieces would need twice as much.
    """

    def __init__(self, fields: tuple[str, ...]) -> None:
        """Start without messages."""
        self.fields = fields
        self._values = bytearray()
        self._times = bytearray()

    def add(self, values: Array, times: Times) -> None:
        """Append values (n, fields) and log times (n,), ns."""
        self._values += np.ascontiguousarray(values).data.cast("B")
        self._times += np.ascontiguousarray(times).data.cast("B")

    def table(self) -> TopicColumns:
        """Return what was added, read-only."""
        values = np.frombuffer(self._values).reshape(-1, len(self.fields))
        times = np.frombuffer(self._times, np.uint64)
        values.flags.writeable = times.flags.writeable = False
        return TopicColumns(self.fields, values, times)
