"""Check of what `plant` adds to a log: the correction beside the schedule, and the sphere's pose.

Everything else in a review is of the schedule, so a note says how far the sphere was from it.
"""

import numpy as np

from ...rotations import Array
from ..finding import Finding, exceeding
from ..own_rotations import to_matrix
from ..recorded_run import RecordedRun

PLANT, CORRECTION = "/plant", "/correction"
_LENGTH = 1e-6  # of a quaternion less 1
_LIMIT = 1e-6  # of a limit, as for the schedule
_ANGLE = 1e-6  # rad: of the error that is logged


def check_plant(run: RecordedRun) -> list[Finding]:
    """Check that schedule and correction keep the limits, and that errors are those of the pose."""
    found = [] if CORRECTION not in run.log.tables else _limits(run)
    return found + ([] if PLANT not in run.log.tables else _pose(run))


def plant_notes(run: RecordedRun) -> tuple[str, ...]:
    """Say that figures are of the schedule, and how far the simulated sphere was from it."""
    if PLANT not in run.log.tables or not len(error := run.log.column(PLANT, "error_rad")):
        return ()
    largest, end = np.degrees(np.abs(error)).max(), np.degrees(np.abs(error[-1]))
    return (
        f"figures are of the schedule; the simulated sphere of /plant was up to {largest:.3g} deg"
        f" from it, and {end:.3g} deg at the end",
    )


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
    return found


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
