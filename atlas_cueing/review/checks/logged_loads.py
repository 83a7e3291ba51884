"""Check of the loads: are they what the motion needs, and can contacts and drives give them?"""

import numpy as np

from ...rotations import Array
from ...signals import LOADS
from ..finding import Finding, exceeding
from ..loads_again import loads_again
from ..recorded_run import RecordedRun

# N, N m, W: the same in another frame and order was within 1e-9 of the largest on every bundled
# flight
ROUNDING = 1e-6
RELATIVE = 1e-8
USE = 1e-6  # of a use: a ratio of two forces
_SIZES = (("f", "n", "N"), ("n", "n", "N"), ("t", "n_m", "N m"), ("p", "w", "W"))


def check_contact_loads(run: RecordedRun) -> list[Finding]:
    """Check the loads of a run on a platform with masses.

    Logged ones are those that the motion needs; torque, motor speed and wheel load keep the limits
    that the platform names; and where it wants them as findings, no wheel slips or lifts off;
    where it keeps traction, none uses more than the margin leaves.
    """
    if not run.platform.has_loads:
        return []
    found = _mismatch(run) + _drives(run)
    return found + _traction(run) if _wants_findings(run) else found


def traction_notes(run: RecordedRun) -> tuple[str, ...]:
    """Slip and lift-off in words, where the platform does not want them as findings."""
    if not run.platform.has_loads:
        return ()
    if _is_kept(run):
        return _kept_note(run)
    if _wants_findings(run):
        return ()
    return tuple(str(finding) for finding in _traction(run))


def logged_loads(run: RecordedRun) -> dict[str, Array]:
    """Loads by their letter in /loads, (n, N): those of the log, or derived where it has none."""
    if LOADS.name not in run.log.tables:
        again = loads_again(run)
        return {
            "f": again.drive, "n": again.normal, "t": again.torque, "p": again.power,
            "use": again.use,
        }  # fmt: skip
    ticks = len(run.flight.time)
    loads = {name: run.log.vector(LOADS.name, name)[:ticks] for name, _, _ in _SIZES}
    uses = [run.log.column(LOADS.name, f"use{k}")[:ticks] for k in (1, 2, 3)]
    return loads | {"use": np.column_stack(uses)}


def _wants_findings(run: RecordedRun) -> bool:
    traction = run.platform.traction
    return traction is not None and (traction.report == "finding" or traction.keep is True)


def _is_kept(run: RecordedRun) -> bool:
    return run.platform.traction is not None and run.platform.traction.keep is True


def _most_use(run: RecordedRun) -> float:
    """The use that a motion may have: all of the friction, or what the kept margin leaves."""
    traction = run.platform.traction
    return 1.0 / traction.margin if traction is not None and traction.keep else 1.0


def _kept_note(run: RecordedRun) -> tuple[str, ...]:
    """Say that traction was kept, by the loads derived here; nothing where it was not."""
    if not len(run.flight.time) or _traction(run):
        return ()
    again, most = loads_again(run), _most_use(run)
    return (
        f"traction kept: {float(again.use.max()):.3f} of the friction in use at most, {most:.3f}"
        f" allowed; normal force {float(again.normal.min()):.6g} N at the least",
    )


def _mismatch(run: RecordedRun) -> list[Finding]:
    """The logged loads against those derived here; a NaN here is not compared."""
    if LOADS.name not in run.log.tables:
        return []
    again, logged, time = loads_again(run), logged_loads(run), run.flight.time
    check, found = "not what the motion needs", []
    derived = {"f": again.drive, "n": again.normal, "t": again.torque, "p": again.power}
    for name, ending, unit in _SIZES:
        places = [f"/loads {name}{k}_{ending}" for k in (1, 2, 3)]
        size = float(np.nanmax(np.abs(derived[name]), initial=0.0))
        off = np.nan_to_num(logged[name] - derived[name], posinf=np.inf, neginf=-np.inf)
        allowed = ROUNDING + RELATIVE * size
        found += exceeding(check, places, time, off, allowed, unit, quantity="difference")
    off = np.where(np.isnan(again.normal), 0.0, logged["use"] - again.use)
    places = [f"/loads use{k}" for k in (1, 2, 3)]
    fair = USE * np.maximum(again.use, 1.0) ** 2  # a wheel about to lift has any use
    return found + exceeding(check, places, time, off, fair, "", quantity="difference")


def _drives(run: RecordedRun) -> list[Finding]:
    """Torque, thermal torque, motor speed and wheel load against the limits of the platform."""
    loads, time, drive = logged_loads(run), run.flight.time, run.platform.drive
    found = []
    if drive and drive.torque_n_m is not None:
        places = [f"/loads t{k}_n_m" for k in (1, 2, 3)]
        found += exceeding("limit", places, time, loads["t"], _fair(drive.torque_n_m), "N m")
    if drive and drive.torque_rms_n_m is not None and len(time):
        found += _thermal(loads["t"], drive.torque_rms_n_m)
    if drive and drive.motor_speed_rad_s is not None:
        places = [f"/wheels w{k}_rad_s at the motor" for k in (1, 2, 3)]
        speed = (drive.gear or 1.0) * run.flight.wheel_speed
        found += exceeding("limit", places, time, speed, _fair(drive.motor_speed_rad_s), "rad/s")
    for k, wheel in enumerate(run.platform.wheel):
        if wheel.load_limit_n is not None:
            place, normal = [f"/loads n{k + 1}_n"], loads["n"][:, k]
            found += exceeding("limit", place, time, normal, _fair(wheel.load_limit_n), "N")
    return found


def _thermal(torque: Array, allowed: float) -> list[Finding]:
    rms = np.sqrt(np.mean(torque**2, axis=0))
    return [
        Finding(
            "limit",
            f"/loads t{k + 1}_n_m",
            None,
            f"rms = {rms[k]:.9g} N m over the run, allowed: rms <= {allowed:.9g} N m",
        )
        for k in np.flatnonzero(rms > _fair(allowed)).tolist()
    ]


def _traction(run: RecordedRun) -> list[Finding]:
    """Slip and lift-off of each wheel, at its worst tick."""
    loads, time = logged_loads(run), run.flight.time
    uses, normals = ([f"/loads {name}" for name in ("use1", "use2", "use3")],
                     [f"/loads n{k}_n" for k in (1, 2, 3)])  # fmt: skip
    touching = np.where(loads["n"] > 0.0, loads["use"], 0.0)
    pulls, fair = np.maximum(-loads["n"], 0.0), _fair(_most_use(run))
    return [
        *exceeding("slip", uses, time, touching, fair, "", quantity="traction use"),
        *exceeding("lift-off", normals, time, pulls, 0.0, "N", quantity="pull needed"),
    ]


def _fair(limit: float) -> float:
    return limit * (1.0 + 1e-9)
