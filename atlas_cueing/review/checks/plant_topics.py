"""Check of what a loop that holds the attitude adds to a log, and a simulated platform.

That is the correction beside the schedule, the estimate, and the sphere's pose. Everything else in
a review is of the schedule, so a note says how far the sphere was from it.
"""

import numpy as np

from ...rotations import Array
from ..finding import Finding, exceeding
from ..own_rotations import to_matrix
from ..recorded_run import RecordedRun

PLANT, CORRECTION, ESTIMATE = "/plant", "/correction", "/estimate"
_LENGTH = 1e-6  # of a quaternion less 1
_LIMIT = 1e-6  # of a limit, as for the schedule
_ANGLE = 1e-6  # rad: of the error that is logged
_BETWEEN = 1e-3  # rad: of one that is between two ticks


def check_plant(run: RecordedRun) -> list[Finding]:
    """Check that schedule and correction keep the limits, and that errors are those of the pose."""
    found = [] if CORRECTION not in run.log.tables else _limits(run)
    found += [] if ESTIMATE not in run.log.tables else _estimate(run)
    return found + ([] if PLANT not in run.log.tables else _pose(run))


def plant_notes(run: RecordedRun) -> tuple[str, ...]:
    """Say that figures are of the schedule, and how far the sphere was from it."""
    notes, whose = [], {PLANT: "the simulated sphere of /plant", ESTIMATE: "by its sensors, it"}
    for topic, what in whose.items():
        if topic not in run.log.tables or not len(error := run.log.column(topic, "error_rad")):
            continue
        largest, end = np.degrees(np.abs(error)).max(), np.degrees(np.abs(error[-1]))
        notes.append(f"{what} was up to {largest:.3g} deg from it, and {end:.3g} deg at the end")
    return (f"figures are of the schedule; {'; '.join(notes)}",) if notes else ()


def _limits(run: RecordedRun) -> list[Finding]:
    flight, limits = run.flight, run.platform.wheel_limit_values()
    count = min(len(flight.time), len(run.log.column(CORRECTION, "time_s")))
    time, found = flight.time[:count], []
    rows = (
        ("w", flight.wheel_speed, limits.speed, "rad_s", "rad/s"),
        ("a", flight.wheel_acceleration, limits.acceleration, "rad_s2", "rad/s2"),
    )
    for name, schedule, limit, unit, shown in rows:
        places = [f"/wheels + {CORRECTION} {name}{i}_{unit}" for i in (1, 2, 3)]
        added = [run.log.column(CORRECTION, f"{name}{i}_{unit}")[:count] for i in (1, 2, 3)]
        both = schedule[:count] + np.column_stack(added)
        found += exceeding("limit", places, time, both, _allowed(limit), shown)
    steps = np.diff(both, axis=0) / np.diff(time)[:, None]  # of the accelerations
    places = [f"/wheels + {CORRECTION} a{i}_rad_s2" for i in (1, 2, 3)]
    found += exceeding("jerk", places, time[1:], steps, _allowed(limits.jerk), "rad/s3")
    return found


def _estimate(run: RecordedRun) -> list[Finding]:
    """The error of an estimate is against the schedule of the estimate's own time."""
    flight, log = run.flight, run.log
    q = np.column_stack([log.column(ESTIMATE, f"q_ws_{c}") for c in "wxyz"])
    count = min(len(flight.time), len(q))
    time, seen = flight.time[:count], log.column(ESTIMATE, "seen_s")[:count]
    known = (seen >= flight.time[0]) & (seen <= time)
    at = np.clip(np.searchsorted(flight.time, seen, side="right") - 1, 0, len(flight.time) - 2)
    share = (seen - flight.time[at]) / (flight.time[at + 1] - flight.time[at])
    one, other = flight.motion_q_WS[at], flight.motion_q_WS[at + 1]
    other = np.where(np.sum(one * other, axis=1)[:, None] < 0.0, -other, other)
    wanted = one + np.clip(share, 0.0, 1.0)[:, None] * (other - one)
    wanted /= np.linalg.norm(wanted, axis=1)[:, None]
    apart = np.linalg.norm(to_matrix(q[:count]) - to_matrix(wanted), axis=(1, 2)) / np.sqrt(8.0)
    angle = 2.0 * np.arcsin(np.minimum(apart, 1.0))
    off = np.where(known, angle - log.column(ESTIMATE, "error_rad")[:count], 0.0)
    places = [f"{ESTIMATE} error_rad"]
    return exceeding("error", places, time, off, _BETWEEN, "rad", quantity="difference")


def _pose(run: RecordedRun) -> list[Finding]:
    flight, log = run.flight, run.log
    q = np.column_stack([log.column(PLANT, f"q_ws_{c}") for c in "wxyz"])
    count = min(len(flight.time), len(q))
    time, q = flight.time[:count], q[:count]
    off = np.linalg.norm(q, axis=1) - 1.0
    found = exceeding("length", [f"{PLANT} q_ws"], time, off, _LENGTH, "", quantity="||q| - 1|")
    if found:
        return found
    R = np.swapaxes(to_matrix(q), 1, 2) @ to_matrix(flight.motion_q_WS[:count])
    # by the chord |R - 1| = 2 sqrt(2) sin(angle / 2), which is good near zero
    chord = np.linalg.norm(R - np.eye(3), axis=(1, 2)) / np.sqrt(8.0)
    angle = 2.0 * np.arcsin(np.minimum(chord, 1.0))
    logged = log.column(PLANT, "error_rad")[:count]
    places = [f"{PLANT} error_rad"]
    return exceeding("error", places, time, angle - logged, _ANGLE, "rad", quantity="difference")


def _allowed(limit: tuple[float, ...]) -> Array:
    return np.asarray(limit) * (1.0 + _LIMIT)
