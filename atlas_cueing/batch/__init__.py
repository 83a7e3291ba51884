"""Runs without a clock: a scenario goes in, a finished log and its figures come out; one (`run`), or thousands (`batch`).

A batch is planned (`plan`), what is missing is flown (`fly_batch`) by processes here (`workers`) or on many machines
(`cluster`), each run alone in a child of its worker (`worker`, `alone`), and ends in a table.
"""

from .batch import Fly, Outcome, fly_batch, missing
from .cluster import on_cluster
from .folder import check_folder
from .interrupt import Interrupt
from .order import Limits
from .output import check_output
from .overview import write_overview
from .plan import PlannedRun, plan
from .record import Record
from .run import RunResult, run_scenario
from .table import metric_names, ordered, rows, write_csv
from .workers import fly_here

__all__ = [
    "Fly",
    "Interrupt",
    "Limits",
    "Outcome",
    "PlannedRun",
    "Record",
    "RunResult",
    "check_folder",
    "check_output",
    "fly_batch",
    "fly_here",
    "metric_names",
    "missing",
    "on_cluster",
    "ordered",
    "plan",
    "rows",
    "run_scenario",
    "write_csv",
    "write_overview",
]
