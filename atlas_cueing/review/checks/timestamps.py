"""Check of time: every topic has every tick, and the ticks are one step apart."""

import numpy as np

from ..finding import Finding, exceeding
from ..recorded_run import TOPICS, RecordedRun
from .rounding import rounding

UNEVEN = 1e-3  # of a step; times are step counts times dt, exact to 1e-12 of a step for an hour
GAP = 1.5  # steps; from here on a tick is missing


def check_timestamps(run: RecordedRun) -> list[Finding]:
    """Check the times of all topics.

    Findings are ticks missing from one topic or from all, topics that disagree on the time, and
    time that is uneven or runs back.
    """
    times = {topic: run.log.column(topic, "time_s") for topic in TOPICS}
    counts = {topic: len(time) for topic, time in times.items()}
    if len(set(counts.values())) > 1:
        return [_lost(times, counts)]
    time, step = run.flight.time, abs(run.step)
    found = []
    for topic in TOPICS:
        place, off = [f"{topic} time_s"], times[topic] - time
        allowed = (rounding(time) + rounding(times[topic]))[:, None]
        found += exceeding(
            "time differs from /motion", place, time, off, allowed, "s", quantity="difference"
        )
    steps = np.diff(time)
    if len(steps):
        back = steps <= 0.0
        gap = ~back & (steps > GAP * step)
        uneven = np.where(back | gap, 0.0, steps - step)
        found += _back(time, steps) if back.any() else []
        found += exceeding(
            "gap",
            ["/motion time_s"],
            time[1:],
            np.where(gap, steps, 0.0),
            GAP * step,
            "s",
            quantity="step",
        )
        found += exceeding(
            "uneven time",
            ["/motion time_s"],
            time[1:],
            uneven,
            UNEVEN * step,
            "s",
            quantity="|step - median|",
        )
    return found


def _back(time: np.ndarray, steps: np.ndarray) -> list[Finding]:
    """Finding at the longest step of time backwards, or where time stands still."""
    worst, count = int(np.argmin(steps)), int(np.count_nonzero(steps <= 0.0))
    often = f" (the worst of {count} steps)" if count > 1 else ""
    text = f"step = {steps[worst]:.9g} s, allowed: step > 0{often}"
    return [Finding("time runs back", "/motion time_s", float(time[worst + 1]), text)]


def _lost(times: dict[str, np.ndarray], counts: dict[str, int]) -> Finding:
    """Finding at the first tick that the longest topic has and the shortest lacks."""
    few, many = min(counts, key=lambda t: counts[t]), max(counts, key=lambda t: counts[t])
    short, long = times[few], times[many]
    same = short == long[: len(short)]
    first = float(long[len(short) if same.all() else int(np.argmin(same))])
    text = (
        f"{counts[few]} messages where {many} has {counts[many]}; all later columns are out of step"
        " and were not checked"
    )
    return Finding("ticks lost", few, first, text)
