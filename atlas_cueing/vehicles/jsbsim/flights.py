"""What to fly: a JSBSim script, or an aircraft with initial conditions and timed inputs."""

from dataclasses import dataclass
from pathlib import Path

DEFAULT_RATE_HZ = 120.0  # of an AircraftFlight; the step of most of JSBSim's own scripts
MIN_RATE_HZ = 10.0  # below it the explicit integrators of JSBSim diverge on ordinary aircraft
# above it rounding of the step is all that is gained; the fastest own script runs at 1000 Hz
MAX_RATE_HZ = 10_000.0


@dataclass(frozen=True, slots=True)
class ScriptFlight:
    """A flight as a JSBSim script tells it.

    script: an XML file of root `runscript`, JSBSim's own or a user's. It names one of JSBSim's own
        aircraft, or one in `models`; its file of initial conditions may lie beside it, or with the
        aircraft.
    rate_hz: steps per second; None for the script's own.
    duration: s; None for the script's own end. It can only shorten the script.
    models: folder of a user's own aircraft (see `user_models.py`); None without.
    """

    script: Path
    rate_hz: float | None = None
    duration: float | None = None
    models: Path | None = None


@dataclass(frozen=True, slots=True)
class InitialConditions:
    """State at time 0, in still air unless an input at time 0 sets a wind.

    altitude: of the centre of gravity above mean sea level, m; the ground lies at 0.
    airspeed: true airspeed, m/s. The velocity points along the body x axis (no angle of attack, no
        sideslip), so without trim the flight path climbs at `pitch`.
    heading, pitch, roll: Euler angles, rad; heading from true north.
    latitude, longitude: geodetic, rad.
    engines_running: all engines run at time 0.
    trim: find controls and attitude of equilibrium first. In flight: full trim along the flight
        path given by `pitch`, which changes pitch and roll. Standing near the ground (see
        `start.py`): settled on the gear.
    """

    altitude: float
    airspeed: float
    heading: float = 0.0
    pitch: float = 0.0
    roll: float = 0.0
    latitude: float = 0.0
    longitude: float = 0.0
    engines_running: bool = True
    trim: bool = False


@dataclass(frozen=True, slots=True)
class TimedInput:
    """From `time` (s) on, `property` goes to `value` (JSBSim's own unit), linearly within `ramp` (s) or at once when 0.

    A ramp starts from the property's value at that moment; of two on one property the later takes
    over from wherever it is. Inputs at time 0 are in effect before the first step and, without a
    ramp, during the trim and in the first state. So set
    wind, gear and flaps at 0, but begin a manoeuvre later: with the stick held over there is
    nothing to trim. Turbulence at 0 begins with the second state.
    """

    time: float
    property: str
    value: float
    ramp: float = 0.0


@dataclass(frozen=True, slots=True)
class AircraftFlight:
    """An aircraft flown by timed inputs.

    duration: s, None for no end. rate_hz: steps per second.
    It is one of JSBSim's own, or the user's in the folder `models` (see `user_models.py`).
    """

    aircraft: str
    initial: InitialConditions
    inputs: tuple[TimedInput, ...] = ()
    rate_hz: float | None = None
    duration: float | None = None
    models: Path | None = None
