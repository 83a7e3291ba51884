"""Adds to the log of a live run where its simulated platform really was."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from ..plant import PLANT_ROW
from ..recording import TopicColumns, read_log, rewrite_log
from ..rotations import Array, geodesic
from ..signals import ESTIMATE, PLANT

_Q, _SLIP, _NORMAL = slice(0, 4), slice(10, 13), slice(13, 16)  # in a row


def add_plant(path: Path, rows: Array) -> dict[str, float]:
    """Write the log at `path` again, with /plant; return figures, the unit in the name.

    rows: (m, 2 + PLANT_ROW) of `PlantDrives`. Without one that has a time of the run nothing is
    written, and there are no figures.

    Raises InputError for a log that cannot be read, OutputError when it cannot be written.
    """
    known = rows[np.isfinite(rows[:, 1])] if rows.size else rows
    log = read_log(path)
    if not len(known) or "/motion" not in log.tables:
        return {}
    time, q_WS = log.column("/motion", "time_s"), log.vector("/motion", "q_ws")
    truth = _at(known, time)
    error = geodesic(q_WS, truth[:, _Q])
    estimate, off = q_WS, error  # an open loop has only what it wanted
    if ESTIMATE.name in log.tables:
        estimate = log.vector(ESTIMATE.name, "q_ws")
        off = geodesic(estimate, _at(known, log.column(ESTIMATE.name, "seen_s"))[:, _Q])
    columns = np.column_stack([time, truth[:, :10], error, estimate, off, truth[:, 10:]])
    table = TopicColumns(PLANT.fields, columns, log.tables["/motion"].log_times)
    new = path.with_name(f"{path.name}.plant")
    rewrite_log(replace(log, tables={**log.tables, PLANT.name: table}), log.metadata, new)
    new.replace(path)
    return {
        "orientation_error_end_deg": float(np.degrees(error[-1])),
        "orientation_error_max_deg": float(np.degrees(error.max())),
        "orientation_error_rms_deg": float(np.degrees(np.sqrt(np.mean(error**2)))),
        "estimate_error_max_deg": float(np.degrees(off.max())),
        "slip_max_m_s": float(np.abs(truth[:, _SLIP]).max()),
        "lift_off_share": float(np.mean((truth[:, _NORMAL] <= 0.0).any(axis=1))),
    }


def _at(known: Array, time: Array) -> Array:
    """Return what the plant did at `time` (n,), s of the run: (n, PLANT_ROW).

    Between two rows lines are drawn, 4 ms long; a quaternion is brought back to length 1.
    """
    found = np.column_stack(
        [np.interp(time, known[:, 1], known[:, 2 + k]) for k in range(PLANT_ROW)]
    )
    found[:, _Q] /= np.linalg.norm(found[:, _Q], axis=1, keepdims=True)
    return found
