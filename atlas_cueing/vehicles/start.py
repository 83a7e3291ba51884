"""The first state: initial conditions, engines, inputs at time 0, trim."""

from math import inf, pi

import jsbsim

from ..errors import InputError, VehicleError
from .flights import AircraftFlight, InitialConditions
from .inputs import InputPlayer
from .loading import JSBSIM_ERRORS, one_line
from .readings import METRES_PER_FOOT

STANDING_AIRSPEED = 1.0  # m/s; a trim slower than this ...
STANDING_HEIGHT = 10.0  # m above ground; ... and lower than this settles the aircraft on its gear
_ALL_ENGINES = -1
_SETTLING_RUNS = 2  # runs of zero length until an input shows in the pilot's force, which lags by one

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

    Raises InputError when the model cannot run and VehicleError at time 0 when its own initial conditions ask for a trim
    that fails.
    """
    try:
        fdm.run_ic()
    except jsbsim.TrimFailureError as error:
        raise VehicleError(0.0, f"no trim at the initial conditions: {one_line(error)}") from error
    except JSBSIM_ERRORS as error:
        raise InputError(f"{fdm.get_model_name()}: JSBSim cannot initialise it: {one_line(error)}") from error


def start_aircraft(fdm: jsbsim.FGFDMExec, flight: AircraftFlight) -> InputPlayer:
    """Bring a loaded aircraft to its first state; gives the player of the inputs still to come.

    Inputs at time 0 act on the trim (gear, flaps, wind) and are set again after it, so that they win over its controls.
    Raises InputError for a bad number or property and VehicleError at time 0 when the aircraft cannot be trimmed.
    """
    initial = flight.initial
    _check(initial)
    player = InputPlayer(flight.inputs, fdm)
    _set(fdm, initial)
    initialise(fdm)
    if initial.engines_running:
        fdm.get_propulsion().init_running(_ALL_ENGINES)
    moved = player.play(0.0)
    if initial.trim:
        _trim(fdm, initial)
        player = InputPlayer(flight.inputs, fdm)
        player.play(0.0)
    if moved:
        _settle(fdm)
    return player


def _check(initial: InitialConditions) -> None:
    """JSBSim turns bad initial conditions into NaN, later."""
    for name, least, greatest in _BOUNDS:
        value = getattr(initial, name)
        if not (least <= value <= greatest and abs(value) < inf):
            raise InputError(f"initial {name} = {value}, allowed: {least:.6g} <= {name} <= {greatest:.6g}, finite")


def _set(fdm: jsbsim.FGFDMExec, initial: InitialConditions) -> None:
    """Position, then attitude, then speed: JSBSim gives the velocity the direction that it has by then."""
    fdm["ic/lat-geod-rad"] = initial.latitude
    fdm["ic/long-gc-rad"] = initial.longitude
    fdm["ic/h-sl-ft"] = initial.altitude / METRES_PER_FOOT
    fdm["ic/psi-true-rad"] = initial.heading
    fdm["ic/theta-rad"] = initial.pitch
    fdm["ic/phi-rad"] = initial.roll
    fdm["ic/vt-fps"] = initial.airspeed / METRES_PER_FOOT


def _trim(fdm: jsbsim.FGFDMExec, initial: InitialConditions) -> None:
    height = METRES_PER_FOOT * fdm["position/h-agl-ft"]
    standing = initial.airspeed < STANDING_AIRSPEED and height < STANDING_HEIGHT
    mode = jsbsim.TrimMode.GROUND if standing else jsbsim.TrimMode.FULL
    try:
        fdm.do_trim(mode)
    except JSBSIM_ERRORS as error:
        raise VehicleError(0.0, f"no {mode.name.lower()} trim at the initial conditions: {one_line(error)}") from error


def _settle(fdm: jsbsim.FGFDMExec) -> None:
    """Let inputs show in the first state without moving it."""
    fdm.suspend_integration()
    for _ in range(_SETTLING_RUNS):
        fdm.run()
    fdm.resume_integration()
