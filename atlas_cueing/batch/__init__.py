"""Runs without a clock: a scenario goes in, a finished log and its figures come out; one (`run`), or thousands (`batch`).

A batch is planned (`plan`), what is missing is flown (`fly_batch`) by processes here (`workers`) or on many machines
(`cluster`), each run alone in a child of its worker (`worker`, `alone`), into a folder or to a URL (`results`), and ends in a
table.
"""

from .batch import Fly, Outcome, fly_batch, missing
from .cluster import on_cluster
from .interrupt import Interrupt
from .order import Limits
from .output import PAGE, check_output
from .overview import overview
from .plan import PlannedRun, plan
from .record import Record
from .results import Results, check_results, results_at
from .run import RunResult, run_scenario
from .table import csv_of, metric_names, ordered, rows
from .workers import fly_here

__all__ = [
    "PAGE",
    "Fly",
    "Interrupt",
    "Limits",
    "Outcome",
    "PlannedRun",
    "Record",
    "Results",
    "RunResult",
    "check_output",
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
    "run_scenario",
]
