"""npz: an array for each column by its name, and arrays of names, units and frames."""

from collections.abc import Callable
from typing import Any, BinaryIO, Final

import numpy as np

from .log_table import TIME, LogTable

FIRST: Final = "atlas_cueing"  # the first array of the file: what --force may replace
NAME_AT: Final = 30  # bytes; where a zip file has the name of its first member


def write_npz(table: LogTable, file: BinaryIO, progress: Callable[[float], None]) -> None:
    """Write a table for `numpy.load`, no pickles in it. Raises OSError.

    `time_s` and `vehicle.wx_rad_s` are (n,) doubles; `names`, `units` and `frames` go together.
    """
    columns = table.columns
    arrays: dict[str, Any] = {
        FIRST: np.array(table.metadata.get("atlas_cueing_version", "")),
        TIME: table.time,
        **{column.name: column.values for column in columns},
        "names": np.array([TIME, *(column.name for column in columns)]),
        "units": np.array(["s", *(column.unit for column in columns)]),
        "frames": np.array(["", *(column.frame for column in columns)]),
    }
    if table.statuses:
        arrays["status.time_s"] = np.array([change.time for change in table.statuses])
        arrays["status.state"] = np.array([change.state for change in table.statuses])
        arrays["status.reason"] = np.array([change.reason for change in table.statuses])
    np.savez(file, **arrays)
    progress(1.0)
