"""Check of the run's result and states, and whether they fit what was recorded."""

import numpy as np

from ...rotations import Array
from ...signals import StateChange
from ..finding import Finding, exceeding
from ..own_rotations import inverse, product, to_vector
from ..recorded_run import RecordedRun

# States in which all is well. The others become notes, and those of a failure findings.
CALM = ("running", "done")
BROKEN = ("fail", "fault", "interrupt", "stopped")
# rad; a run reports jumps from 0.5 deg on; near that bound two ways of computing may differ
JUMP = np.radians(0.6)


def check_status(run: RecordedRun) -> list[Finding]:
    """Check the result, the states of failure, and jumps of attitude that no state reports."""
    metadata = run.log.metadata
    result, reason = metadata.get("result", ""), metadata.get("reason", "")
    found = []
    if not metadata:
        text = "the log has no such record: how the run ended, and with what, is unknown"
        found.append(Finding("result", "atlas.run", None, text))
    elif result != "ok":
        found.append(
            Finding(
                "result",
                "atlas.run",
                None,
                f"result = {result!r}, allowed: 'ok'" + (f"; {reason}" if reason else ""),
            )
        )
    found += [
        Finding("fault", "/status", status.time, f"{status.state}: {status.reason}".rstrip(": "))
        for status in run.log.statuses
        if _is_broken(status) and status.state != result
    ]
    if not len(run.flight.time):
        found.append(Finding("empty", "/motion", None, "no tick was recorded"))
    return found + _unreported_jumps(run)


def state_notes(run: RecordedRun) -> list[str]:
    """Notes on the intervals of states other than calm ones and failures."""
    lines = []
    for begin, end, status in state_intervals(run):
        if not _is_broken(status):
            until = "" if end is None else f" to {end:.6f}"
            lines.append(f"{begin:.6f}{until} s {status.state}: {status.reason}".rstrip(": "))
    return lines


def state_intervals(run: RecordedRun) -> list[tuple[float, float | None, StateChange]]:
    """Intervals of the states that are not calm: begin and end, s, and the change to the state.

    The end is None where the state lasted to the end of the run.
    """
    ends = [*(status.time for status in run.log.statuses[1:]), None]
    return [
        (status.time, end, status)
        for status, end in zip(run.log.statuses, ends, strict=False)
        if status.state not in CALM
    ]


def _is_broken(status: StateChange) -> bool:
    return any(word in status.state.lower() for word in BROKEN)


def _unreported_jumps(run: RecordedRun) -> list[Finding]:
    """Find ticks at which the vehicle turned by more than its body rates explain.

    Ticks in an interval of a state that is not calm do not count.
    """
    flight = run.flight
    if len(flight.time) < 2:
        return []
    q, w, h = flight.vehicle_q_NB, flight.vehicle_w_B, np.diff(flight.time)[:, None]
    step = to_vector(product(inverse(q[:-1]), q[1:])) - 0.5 * h * (w[:-1] + w[1:])
    unreported = np.where(_calm(run, flight.time[1:]), np.linalg.norm(step, axis=1), 0.0)
    check = "attitude jumps and no state tells of it"
    return exceeding(
        check, ["/vehicle q_nb"], flight.time[1:], unreported, JUMP, "rad", quantity="step"
    )


def _calm(run: RecordedRun, time: Array) -> np.ndarray:
    """Whether only calm states held or began at each time (n,), s.

    Without any states all times are calm.
    """
    statuses = sorted(run.log.statuses, key=lambda status: status.time)
    calm = np.array([True, *(status.state in CALM for status in statuses)])
    held = calm[np.searchsorted([status.time for status in statuses], time, side="right")]
    # a state may end at the tick at which it began: the last one of a run is `done` too
    began = np.isin(time, [status.time for status in statuses if status.state not in CALM])
    quiet: np.ndarray = held & ~began
    return quiet
