"""Check that every logged number is finite, and every flag 0 or 1."""

import numpy as np

from ..finding import Finding
from ..recorded_run import RecordedRun


def check_finite(run: RecordedRun) -> list[Finding]:
    """Find fields with values that are not finite, and flags that are neither 0 nor 1."""
    found = []
    for topic, table in run.log.tables.items():
        time = (
            run.log.column(topic, "time_s")
            if "time_s" in table.fields
            else np.arange(float(len(table.values)))
        )
        good = np.isfinite(table.values)
        found += [
            _finding(
                "not a number",
                topic,
                table.fields[k],
                time,
                table.values[:, k],
                good[:, k],
                "finite",
            )
            for k in np.flatnonzero(~good.all(axis=0))
        ]
        for k, field in enumerate(table.fields):
            flags = table.values[:, k]
            fair = (flags == 0.0) | (flags == 1.0)
            if field.endswith("_limited") and not fair.all():
                found.append(_finding("no flag", topic, field, time, flags, fair, "0 or 1"))
    return found


def _finding(
    check: str,
    topic: str,
    field: str,
    time: np.ndarray,
    values: np.ndarray,
    good: np.ndarray,
    allowed: str,
) -> Finding:
    first, count = int(np.argmin(good)), int((~good).sum())
    more = f" (the first of {count} ticks)" if count > 1 else ""
    when = float(time[first]) if np.isfinite(time[first]) else None
    return Finding(
        check, f"{topic} {field}", when, f"value = {values[first]:g}, allowed: {allowed}{more}"
    )
