"""The one table of a topic that lies on several channels, or in chunks of another order."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .log import Growing, Status, Table
from .pieces import Pieces, merged_order
from .wire import Times


class GrowingStates:
    """Changes of state of a channel that is not complete yet."""

    def __init__(self) -> None:
        """No changes yet."""
        self.states: list[Status] = []
        self.pieces = Pieces()

    def add(self, states: Sequence[Status], times: Times, *, loose: bool = False) -> None:
        """States and their log times (n,), ns, that follow."""
        self.states += states
        self.pieces.add(times, loose=loose)


def merged_states(channels: Sequence[GrowingStates]) -> tuple[Status, ...]:
    """The changes of state of all channels, in order as those of `merged`."""
    states = [state for channel in channels for state in channel.states]
    return tuple(states[row] for row in merged_order([channel.pieces for channel in channels]))


def merged(channels: Sequence[Growing]) -> Table:
    """The table of one topic from all its channels, in order of log time.

    Channels are merged as sorted lists are: none of them is put in another order within itself. Fields
    that not all channels have are left out.
    """
    if len(channels) == 1:
        table = channels[0].table()
        order = channels[0].pieces.order()
        return table if _in_order(order) else _rows(table, order)
    fields = common_fields(channels)
    tables = [channel.table() for channel in channels]
    columns = [[table.fields.index(name) for name in fields] for table in tables]
    values = np.concatenate([table.values[:, picked] for table, picked in zip(tables, columns, strict=True)])
    times = np.concatenate([table.log_times for table in tables])
    return _rows(Table(fields, values, times), merged_order([channel.pieces for channel in channels]))


def common_fields(channels: Sequence[Growing]) -> tuple[str, ...]:
    """Fields that all channels have, in the order of the first."""
    return tuple(name for name in channels[0].fields if all(name in other.fields for other in channels[1:]))


def _in_order(order: NDArray[np.intp]) -> bool:
    return bool(np.all(order[1:] > order[:-1]))


def _rows(table: Table, order: NDArray[np.intp]) -> Table:
    values, times = table.values[order], table.log_times[order]
    values.flags.writeable = times.flags.writeable = False
    return Table(table.fields, values, times)
