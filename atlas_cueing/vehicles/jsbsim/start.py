"""The first state: initial conditions, engines, inputs at time 0, trim."""

from dataclasses import replace
from math import degrees, inf, pi

import jsbsim

from ...errors import InputError, StartError, VehicleError
from .flights import AircraftFlight, InitialConditions, TimedInput
from .ground import check_standing, stand_objection
from .inputs import InputPlayer
from .library import JSBSIM_ERRORS, one_line
from .loading import naming_aircraft
from .readings import METRES_PER_FOOT

STANDING_AIRSPEED = 1.0  # m/s; a trim slower than this ...
STANDING_HEIGHT = 10.0  # m above ground; ... and lower than this settles the aircraft on its gear
_ALL_ENGINES = -1
_TURBULENCE = ("atmosphere/turb", "atmosphere/cosine-gust/")
# runs of zero length until an input shows in the pilot's force, which lags by one
_SETTLING_RUNS = 2

# field, least, greatest
_BOUNDS = (
    ("altitude", -500.0, 1e8),  # m; the lowest land lies at -430
    ("airspeed", 0.0, 2e4),  # m/s; escape speed is 1.1e4
    ("heading", -inf, inf),  # rad
    ("pitch", -0.5 * pi, 0.5 * pi),
    ("roll", -2.0 * pi, 2.0 * pi),
    ("latitude", -0.5 * pi, 0.5 * pi),
    ("longitude", -2.0 * pi, 2.0 * pi),
)


def initialise(fdm: jsbsim.FGFDMExec) -> None:
    """Bring a loaded model to the state of its initial conditions, a script to its first state.

    Raises InputError when the model cannot run.
    """
    try:
        fdm.run_ic()
    except JSBSIM_ERRORS as error:
        raise InputError(
            f"{fdm.get_model_name()}: JSBSim cannot initialise it: {one_line(error)}"
        ) from error


def start_aircraft(fdm: jsbsim.FGFDMExec, flight: AircraftFlight) -> InputPlayer:
    """Bring a loaded aircraft to its first state; gives the player of the inputs still to come.

    Inputs at time 0 act on the trim (gear, flaps, wind) and are set again after it, so that they
    win over its controls; turbulence, which has no equilibrium, and in JSBSim no value at rest, is
    set one step later.

    Raises InputError for a bad number or property, and StartError when the aircraft cannot be
    trimmed or starts in the ground (see `ground.py`).
    """
    initial = flight.initial
    _check(initial)
    inputs = [_after_start(event, fdm.get_delta_t()) for event in flight.inputs]
    player = InputPlayer(inputs, fdm)
    _set(fdm, initial)
    with naming_aircraft(flight):
        initialise(fdm)
    if initial.engines_running:
        fdm.get_propulsion().init_running(_ALL_ENGINES)
    try:
        if initial.trim:
            InputPlayer(inputs, fdm).play(0.0)
            _trim(fdm, flight)
        moved = player.play(0.0)
    except VehicleError as error:
        raise StartError(f"{error.reason}; allowed at time 0: what does not fail there") from error
    if moved:
        _settle(fdm)
    check_standing(fdm, initial)
    return player


def _after_start(event: TimedInput, dt: float) -> TimedInput:
    return replace(event, time=max(event.time, dt)) if _is_turbulence(event) else event


def _is_turbulence(event: TimedInput) -> bool:
    return event.property.lstrip("/").startswith(_TURBULENCE)


def _check(initial: InitialConditions) -> None:
    """JSBSim turns bad initial conditions into NaN, later."""
    for name, least, greatest in _BOUNDS:
        value = getattr(initial, name)
        if not (least <= value <= greatest and abs(value) < inf):
            raise InputError(
                f"initial {name} = {value}, allowed: {least:.6g} <= {name} <= {greatest:.6g},"
                " finite"
            )


def _set(fdm: jsbsim.FGFDMExec, initial: InitialConditions) -> None:
    """Set position, then attitude, then speed.

    JSBSim gives the velocity the direction that it has by then.
    """
    fdm["ic/lat-geod-rad"] = initial.latitude
    fdm["ic/long-gc-rad"] = initial.longitude
    fdm["ic/h-sl-ft"] = initial.altitude / METRES_PER_FOOT
    fdm["ic/psi-true-rad"] = initial.heading
    fdm["ic/theta-rad"] = initial.pitch
    fdm["ic/phi-rad"] = initial.roll
    fdm["ic/vt-fps"] = initial.airspeed / METRES_PER_FOOT


def _trim(fdm: jsbsim.FGFDMExec, flight: AircraftFlight) -> None:
    initial = flight.initial
    height = METRES_PER_FOOT * fdm["position/h-agl-ft"]
    standing = initial.airspeed < STANDING_AIRSPEED and height < STANDING_HEIGHT
    mode = jsbsim.TrimMode.GROUND if standing else jsbsim.TrimMode.FULL
    try:
        reason = stand_objection(fdm) if standing else ""
        if not reason:
            fdm.do_trim(mode)
    except JSBSIM_ERRORS as error:
        reason = f"JSBSim: {one_line(error)}"
    if reason:
        failed = f"no {mode.name.lower()} trim of {flight.aircraft!r}"
        raise StartError(f"initial.trim = true: {failed} {_advice(flight, standing, reason)}")


def _advice(flight: AircraftFlight, standing: bool, reason: str) -> str:
    """Under which conditions the trim failed, and what to do."""
    initial = flight.initial
    where = f"at altitude_m = {initial.altitude:g}, airspeed_m_s = {initial.airspeed:g}"
    where += f", pitch_deg = {degrees(initial.pitch):g}"
    at_start = {
        event.property for event in flight.inputs if event.time == 0.0 and not _is_turbulence(event)
    }
    acting = (
        f" (at time 0 these act on the trim: {', '.join(sorted(at_start))})" if at_start else ""
    )
    steady = "a start above the ground" if standing else "an altitude and airspeed of steady flight"
    later = f", later inputs{acting}" if acting else ""
    return f"{where}: {reason}; allowed: {steady}{later}, or trim = false"


def _settle(fdm: jsbsim.FGFDMExec) -> None:
    """Let inputs show in the first state without moving it."""
    fdm.suspend_integration()
    for _ in range(_SETTLING_RUNS):
        fdm.run()
    fdm.resume_integration()
