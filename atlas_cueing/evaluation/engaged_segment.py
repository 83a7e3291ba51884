"""The part of a live run in which the platform follows the vehicle.

Only this part has metrics: a parked platform is not meant to follow.
"""

from collections.abc import Sequence
from itertools import groupby

import numpy as np

from ..signals import StateChange
from .run_columns import RunColumns

RUNNING = "running"


def engaged_segment(flight: RunColumns, changes: Sequence[StateChange]) -> RunColumns:
    """The longest stretch of a run in state `running`; without ticks if it was never in it.

    A change of state at t counts from the tick at t on, which is the first of the new state.
    """
    # a state with a new reason goes on
    changes = [next(same) for _, same in groupby(changes, lambda change: change.state)]
    starts = np.array([change.time for change in changes])
    ends = np.append(starts, np.inf)[1:]
    stretches = [
        slice(*np.searchsorted(flight.time, (start, end)))
        for start, end, change in zip(starts, ends, changes, strict=True)
        if change.state == RUNNING
    ]
    return flight.rows(max(stretches, key=lambda rows: rows.stop - rows.start, default=slice(0, 0)))
