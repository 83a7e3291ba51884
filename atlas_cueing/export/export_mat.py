"""mat: a struct for each topic, and units and frames in structs of the same shape."""

from collections.abc import Callable
from typing import Any, BinaryIO, Final

import numpy as np

from ..errors import InputError
from .log_table import TIME, LogTable

BEGINS: Final = b"MATLAB 5.0 MAT-file, atlas_cueing"  # what --force may replace
_HEAD = 116  # bytes of text in front of the file
_LARGEST = 2**31  # bytes of one variable of this format
_RESERVED = ("units", "frames", TIME)


def write_mat(table: LogTable, file: BinaryIO, progress: Callable[[float], None]) -> None:
    """Write a table for MATLAB and `scipy.io.loadmat` (level 5). Raises OSError.

    `vehicle.wx_rad_s` is a column over `time_s`; `units.vehicle.wx_rad_s` is "rad/s". Raises
    InputError where a topic is larger than the format allows.
    """
    from scipy.io import savemat

    units, frames = _struct(table, "unit"), _struct(table, "frame")
    content: dict[str, Any] = {TIME: table.time, **_struct(table, "values")}
    for topic, fields in content.items():
        size = 8 * len(table.time) * (len(fields) if isinstance(fields, dict) else 1)
        if size >= _LARGEST:
            raise InputError(
                f"{topic}: {size / 1e9:.1f} GB, allowed in a mat file: less than 2 GB a topic;"
                " choose .npz or .parquet"
            )
    if table.statuses:
        content["status"] = {
            TIME: np.array([change.time for change in table.statuses]),
            "state": np.array([change.state for change in table.statuses], object),
            "reason": np.array([change.reason for change in table.statuses], object),
        }
    content |= {"units": {TIME: "s", **units}, "frames": frames}
    target: Any = file  # its types know names of files only
    savemat(target, content, long_field_names=True, oned_as="column")
    file.seek(0)
    file.write(BEGINS.ljust(_HEAD))
    progress(1.0)


def _struct(table: LogTable, attribute: str) -> dict[str, dict[str, Any]]:
    """One attribute of all columns, by topic and field."""
    found: dict[str, dict[str, Any]] = {}
    for column in table.columns:
        topic = column.topic.replace("/", "_").replace(".", "_")
        topic = f"{topic}_" if topic in _RESERVED else topic
        found.setdefault(topic, {})[column.field] = getattr(column, attribute)
    return found
