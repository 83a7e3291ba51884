"""Runs without a clock: a scenario goes in, a finished log and its figures come out; one (`run`), or thousands (`batch`).

A batch is planned (`plan`), what is missing is flown (`fly_batch`) by processes here (`workers`) or on many machines
(`cluster`), each run alone in a child of its worker (`worker`, `alone`), into a folder or to a URL (`results`), and ends in a
table.
"""

from .cluster import on_cluster
from .fly_batch import Fly, Outcome, fly_batch, missing
from .job import Limits
from .job_result import Record
from .overview import overview
from .plan import PlannedRun, plan
from .pool import fly_here
from .store import Results, check_results, results_at
from .table import csv_of, metric_names, ordered, rows

__all__ = [
    "Fly",
    "Limits",
    "Outcome",
    "PlannedRun",
    "Record",
    "Results",
    "check_results",
    "csv_of",
    "fly_batch",
    "fly_here",
    "metric_names",
    "missing",
    "on_cluster",
    "ordered",
    "overview",
    "plan",
    "results_at",
    "rows",
]
