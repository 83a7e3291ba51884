"""Merges the messages of a topic that is on several channels, or not in the order of time."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..signals import StateChange
from .log import Growing, TopicColumns
from .wire import Times

Rows = NDArray[np.intp]
States = tuple[list[StateChange], list[int]]  # changes of state, and their log times, ns


def merged(channels: Sequence[Growing]) -> TopicColumns:
    """Return the columns of one topic from all its channels, in order of log time.

    Fields that not all channels have are left out.
    """
    tables, fields = [channel.table() for channel in channels], common_fields(channels)
    rows = merged_order([table.log_times for table in tables])
    if len(tables) == 1 and np.all(rows[1:] > rows[:-1]):
        return tables[0]  # as it lies in memory
    columns = [[table.fields.index(name) for name in fields] for table in tables]
    values = np.concatenate(
        [table.values[:, picked] for table, picked in zip(tables, columns, strict=True)]
    )[rows]
    times = np.concatenate([table.log_times for table in tables])[rows]
    values.flags.writeable = times.flags.writeable = False
    return TopicColumns(fields, values, times)


def merged_states(channels: Sequence[States]) -> tuple[StateChange, ...]:
    """Return the changes of state of all channels, in order of log time."""
    states = [state for of_channel, _ in channels for state in of_channel]
    return tuple(
        states[row]
        for row in merged_order([np.array(times, dtype=np.uint64) for _, times in channels])
    )


def common_fields(channels: Sequence[Growing]) -> tuple[str, ...]:
    """Return the fields that all channels have, in the order of the first."""
    return tuple(
        name for name in channels[0].fields if all(name in other.fields for other in channels[1:])
    )


def merged_order(channels: Sequence[Times]) -> Rows:
    """Return the rows of all channels, one after the other, in order of log time (n,), ns.

    Channels are merged as sorted lists are: none is put in another order than that of `time_order`.
    """
    orders = [time_order(times) for times in channels]
    keys = [
        np.maximum.accumulate(times[order]) for times, order in zip(channels, orders, strict=True)
    ]
    starts = np.cumsum([0, *map(len, channels)])
    rows = [start + order for start, order in zip(starts[:-1], orders, strict=True)]
    return np.concatenate([np.empty(0, np.intp), *rows])[
        np.argsort(np.concatenate([np.empty(0, np.uint64), *keys]), kind="stable")
    ]


def time_order(times: Times) -> Rows:
    """Return the rows of a channel in order of log time (n,), ns, by moving whole stretches.

    MCAP lets a writer put chunks in any order. Stretches that overlap stay as they are in the file:
    they are ticks that were recorded in the wrong order, which has to be found.
    """
    starts = np.flatnonzero(np.diff(times.astype(np.int64), prepend=-1) < 0)
    starts = np.concatenate([[0], starts]) if len(times) else starts
    sizes = np.diff(starts, append=len(times))
    first, last = times[starts], times[starts + sizes - 1]
    by_time = np.lexsort((last, first))
    if np.any(last[by_time][:-1] > first[by_time][1:]):
        return np.arange(len(times))
    sizes, before = sizes[by_time], np.cumsum(sizes[by_time]) - sizes[by_time]
    return np.repeat(starts[by_time] - before, sizes) + np.arange(len(times))
