"""Check of a live run's timing: do lateness, real time and missed deadlines fit each other?"""

import numpy as np

from ...rotations import Array
from ...signals import TIMING
from ..finding import Finding, exceeding
from ..recorded_run import RecordedRun

ROUNDING = 1e-6  # s; time of the run and of the clock are sums of steps in another order


def is_live(run: RecordedRun) -> bool:
    """Whether the log is of a live run that recorded its timing."""
    return TIMING.name in run.log.tables and len(run.log.tables[TIMING.name].values) > 0


def timing(run: RecordedRun, field: str) -> Array:
    """A field of /timing (n,), cut to the length of the run."""
    return run.log.column(TIMING.name, field)[: len(run.flight.time)]


def check_deadlines(run: RecordedRun) -> list[Finding]:
    """Check the timing of a live run.

    Real time goes on as the run's own time does, and no tick began early. Logs of earlier versions
    left missed deadlines out, and real time is behind by these.
    """
    if (
        not is_live(run)
        or len(run.flight.time) < 2
        or len(timing(run, "elapsed_s")) != len(run.flight.time)
    ):
        return []
    time, late = run.flight.time, timing(run, "lateness_s")
    behind = np.diff(timing(run, "elapsed_s")) - np.diff(time)
    # a tick that is late misses deadlines after its own: they lie between it and the next one
    missed = np.diff(timing(run, "missed_deadlines"), prepend=0.0)[:-1] * run.step
    missed = np.where(np.abs(behind) <= ROUNDING, 0.0, missed)
    check, place = "real time does not fit the missed deadlines", ["/timing elapsed_s"]
    early = np.where(late < 0.0, late, 0.0)
    return [
        *exceeding(check, place, time[1:], behind - missed, ROUNDING, "s", quantity="difference"),
        *exceeding(
            "a tick began early",
            ["/timing lateness_s"],
            time,
            early,
            0.0,
            "s",
            quantity="|lateness|",
        ),
    ]


def punctuality_notes(run: RecordedRun) -> list[str]:
    """Notes on a live run: lateness and cost of its ticks, and its missed deadlines."""
    if not is_live(run):
        return []
    late, cost = 1e6 * timing(run, "lateness_s"), 1e6 * timing(run, "cost_s")
    missed = int(timing(run, "missed_deadlines")[-1])
    lines = [f"{missed} deadlines missed"] if missed else []
    for name, values in (("lateness", late), ("tick cost", cost)):
        p50, p99, p999 = np.percentile(values, [50.0, 99.0, 99.9], method="inverted_cdf")
        lines.append(
            f"{name} p50 {p50:.0f}, p99 {p99:.0f}, p99.9 {p999:.0f}, max {values.max():.0f} us"
        )
    return lines
