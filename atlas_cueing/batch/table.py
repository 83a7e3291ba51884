"""Every run of a batch in a row: what it was, what came of it, and every figure."""

import csv
from collections.abc import Mapping, Sequence
from io import StringIO
from math import inf, isnan
from typing import Any, TypeAlias

from ..evaluation import DECLARED, Metric
from ..evaluation.units import COUNT, DURATION
from .beside_still import mismatch_ratios
from .fly_batch import Outcome

Row: TypeAlias = Mapping[str, Any]  # column to value; a column that a run does not have is missing

NOT_FLOWN = "not_flown"
_OF_A_RUN = (
    Metric("wall", DURATION, "Time that the computation of the run took."),
    Metric("violations", COUNT, "Limits that the run exceeded."),
)
METRIC_COLUMNS: Mapping[str, Metric] = {
    **DECLARED,
    **{metric.name: metric for metric in _OF_A_RUN},
}
"""Columns by which a table can be sorted, by name."""


def rows(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    """Make a row for each run.

    It has id, file, scenario, vehicle, method, platform, the values that its sweep set, result, and
    all figures, and its mismatch_ratio where a run by `still` is there to compare it with.
    """
    ratios = mismatch_ratios(outcomes)
    return [_row(outcome) | ratios.get(outcome.run.id, {}) for outcome in outcomes]


def _row(outcome: Outcome) -> dict[str, Any]:
    run, result = outcome.run, outcome.result
    file = run.scenario.file
    what = {
        "run": run.id,
        "source": run.source.name,
        "scenario": run.scenario.name,
        "vehicle": file.vehicle.flown,
        "method": file.cueing.declaration.name,
        "platform": run.scenario.platform.name,
        **run.settings,
    }
    if result is None:
        return {**what, "result": NOT_FLOWN}
    came = {
        "result": result.result,
        "reason": result.reason,
        "log": str(result.log or ""),
        "wall_s": result.wall,
    }
    figures = {**result.evaluation.metrics, "ticks": result.ticks, "duration_s": result.duration}
    use = {f"limit_use_{name}": value for name, value in result.evaluation.limit_use.items()}
    return {**what, **came, "violations": len(result.evaluation.violations), **figures, **use}


def ordered(table: Sequence[Row], metric: str) -> list[Row]:
    """Sort the rows by a metric, the smallest first.

    Runs that failed come last, likewise sorted: their figures are of a part of the flight.
    """
    return sorted(table, key=lambda row: (row["result"] != "ok", _rank(row.get(metric))))


def _rank(value: Any) -> float:
    """The number itself; infinity for anything else, so that it comes last."""
    return value if isinstance(value, int | float) and not isnan(value) else inf


def columns(table: Sequence[Row]) -> list[str]:
    """Names of all columns, in the order in which they first appear."""
    return list(dict.fromkeys(name for row in table for name in row))


def csv_of(table: Sequence[Row]) -> str:
    """The table as CSV, with all digits of numbers, and lists in the syntax of Python."""
    text = StringIO(newline="")
    writer = csv.DictWriter(text, columns(table), restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(table)
    return text.getvalue()
