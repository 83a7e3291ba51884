"""How did the run go by its own account, and does the account fit what was recorded?"""

import numpy as np

from ...rotations import Array
from ...signals import StateChange
from ..finding import Finding, exceeding
from ..own_rotations import inverse, product, to_vector
from ..recorded_run import RecordedRun

# States that say all is well. Others are told as notes, and those that say something broke are
# findings.
CALM = ("running", "done")
BROKEN = ("fail", "fault", "interrupt", "stopped")
# a run notes jumps from 0.5 deg on; near that bound two ways of reckoning may differ
JUMP = np.radians(0.6)


def check_status(run: RecordedRun) -> list[Finding]:
    """The run's result, states of failure, and jumps of the vehicle's attitude that no state tells of."""
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
    return found + _untold_jumps(run)


def notes(run: RecordedRun) -> list[str]:
    """What a reader should know that is no fault: each spell of another state."""
    told = []
    for begin, end, status in spells(run):
        if not _is_broken(status):
            until = "" if end is None else f" to {end:.6f}"
            told.append(f"{begin:.6f}{until} s {status.state}: {status.reason}".rstrip(": "))
    return told


def spells(run: RecordedRun) -> list[tuple[float, float | None, StateChange]]:
    """Each spell of a state that is not calm: when it began and ended, s (None.

    Never), and what was said of it.
    """
    ends = [*(status.time for status in run.log.statuses[1:]), None]
    return [
        (status.time, end, status)
        for status, end in zip(run.log.statuses, ends, strict=False)
        if status.state not in CALM
    ]


def _is_broken(status: StateChange) -> bool:
    return any(word in status.state.lower() for word in BROKEN)


def _untold_jumps(run: RecordedRun) -> list[Finding]:
    """Ticks at which the vehicle turned by more than its body rates explain, outside every spell that the log tells of."""
    flight = run.flight
    if len(flight.time) < 2:
        return []
    q, w, h = flight.vehicle_q_NB, flight.vehicle_w_B, np.diff(flight.time)[:, None]
    step = to_vector(product(inverse(q[:-1]), q[1:])) - 0.5 * h * (w[:-1] + w[1:])
    untold = np.where(_calm(run, flight.time[1:]), np.linalg.norm(step, axis=1), 0.0)
    check = "attitude jumps and no state tells of it"
    return exceeding(
        check, ["/vehicle q_nb"], flight.time[1:], untold, JUMP, "rad", quantity="step"
    )


def _calm(run: RecordedRun, time: Array) -> np.ndarray:
    """Whether no state but calm ones held or began at each time.

    Without any states all are calm.
    """
    statuses = sorted(run.log.statuses, key=lambda status: status.time)
    calm = np.array([True, *(status.state in CALM for status in statuses)])
    held = calm[np.searchsorted([status.time for status in statuses], time, side="right")]
    # a state may end at the tick at which it began: the last one of a run is `done` too
    began = np.isin(time, [status.time for status in statuses if status.state not in CALM])
    quiet: np.ndarray = held & ~began
    return quiet
