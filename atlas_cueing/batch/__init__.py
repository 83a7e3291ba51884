"""Runs without a clock: a scenario goes in, a finished log and its figures come out.

One (`run`), or thousands (`batch`).

A batch is planned (`plan`), what is missing is flown (`fly_batch`) by processes here (`workers`) or
on many machines (`cluster`), each run alone in a child of its worker (`worker`, `alone`), into a
folder or to a URL (`results`), and ends in a table.
"""

from .cluster import on_cluster
from .fly_batch import Fly, Outcome, fly_batch, missing
from .job import RunLimits
from .job_result import JobResult
from .overview import overview
from .plan import PlannedRun, plan
from .pool import fly_here
from .store import ResultStore, check_results, open_store
from .table import METRIC_COLUMNS, csv_of, ordered, rows

__all__ = [
    "METRIC_COLUMNS",
    "Fly",
    "JobResult",
    "Outcome",
    "PlannedRun",
    "ResultStore",
    "RunLimits",
    "check_results",
    "csv_of",
    "fly_batch",
    "fly_here",
    "missing",
    "on_cluster",
    "open_store",
    "ordered",
    "overview",
    "plan",
    "rows",
]
