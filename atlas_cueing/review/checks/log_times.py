"""Check that log times and /tf, which viewers use, agree with the columns."""

import numpy as np

from ...rotations import Array
from ...signals import ALL_TOPICS, TIMING
from ..finding import Finding, exceeding
from ..recorded_run import RecordedRun
from .rounding import rounding

ROUNDING = 1.0  # ns; log times are whole ones
SIMULATED = 946_684_800_000_000_000  # ns; 2000-01-01T00:00:00Z, from where simulated time counts
TRANSFORMS = 2.0 / 60.0  # s without a /tf, beside a tick; one is due every sixtieth


def check_log_times(run: RecordedRun) -> list[Finding]:
    """Check the log time of each message, and /tf.

    The log time is simulated time counted from the year 2000, in a live log the real time elapsed.
    """
    tables = {
        topic.name: run.log.tables[topic.name]
        for topic in ALL_TOPICS
        if topic.name in run.log.tables
    }
    found = []
    for topic, table in tables.items():
        if len(table.log_times) == len(table.values) > 0:
            found += _misfits(run, topic, table.log_times)
    return found + _transforms(run)


def _misfits(run: RecordedRun, topic: str, log_times: np.ndarray) -> list[Finding]:
    """Find log times of a topic (n,), ns, that do not fit its column of time."""
    live = TIMING.name in run.log.tables
    time = run.log.column(topic, "time_s")
    since = run.log.column(TIMING.name, "elapsed_s") if live else time
    if len(since) != len(log_times) or not np.isfinite(since).all():
        return []  # found elsewhere
    start = _start(since, log_times) if live else SIMULATED
    off = (log_times.astype(np.int64) - start).astype(np.float64) - np.rint(since * 1e9)
    what = "elapsed_s" if live else "time_s"
    check = f"log time does not fit {what}"
    allowed = ROUNDING + (
        0.0 if live else 1e9 * (rounding(time) + rounding(_seconds(log_times)))[:, None]
    )
    return exceeding(check, [f"{topic} log_time"], time, off, allowed, "ns", quantity="difference")


def _seconds(log_times: np.ndarray) -> Array:
    """Log times (n,), ns, as seconds since the first of them."""
    since: Array = (log_times.astype(np.int64) - int(log_times[0])) / 1e9
    return since


def _start(since: Array, log_times: np.ndarray) -> int:
    """Wall-clock time at the start of a live run, ns, by the median over the ticks."""
    starts = log_times.astype(np.int64) - np.rint(since * 1e9).astype(np.int64)
    # ns since 1970 are more than a double holds
    return int(starts[0]) + int(np.median(starts - starts[0]))


def _transforms(run: RecordedRun) -> list[Finding]:
    """Check that /tf is the motion of the tick with the same log time, sixty times a second."""
    poses, motion, flight = run.log.transforms, run.log.tables["/motion"], run.flight
    if poses is None or len(motion.log_times) != len(flight.time) or not len(flight.time):
        return []
    tick = np.searchsorted(motion.log_times, poses.log_times).clip(0, len(flight.time) - 1)
    time = flight.time[tick]
    strange = motion.log_times[tick] != poses.log_times
    pose = np.hstack([flight.motion_p_W, flight.motion_q_WS])[tick]
    off = np.where(strange[:, None], 0.0, poses.values - pose)
    gaps = np.diff(np.concatenate([flight.time[:1], time, flight.time[-1:]]))
    at = np.append(time, flight.time[-1])
    longest = TRANSFORMS + run.step
    return [
        *exceeding(
            "no tick has this log time",
            ["/tf"],
            time,
            strange.astype(float),
            0.0,
            "",
            quantity="messages",
        ),
        *exceeding(
            "differs from /motion",
            [f"/tf {name}" for name in poses.fields],
            time,
            off,
            0.0,
            "",
            quantity="difference",
        ),
        *exceeding("no /tf for too long", ["/tf"], at, gaps, longest, "s", quantity="gap"),
    ]
