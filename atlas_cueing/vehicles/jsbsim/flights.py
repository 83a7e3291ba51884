"""What to fly: a JSBSim script, or an aircraft with initial conditions and timed inputs."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from ...printable import utf8
from ...signals import Vehicle
from ..flight import Flight
from .library import own_scripts
from .script_run import script_run
from .user_models import beside, plain_name, read_users, user_files, user_model

DEFAULT_RATE_HZ = 120.0  # of an AircraftFlight; the step of most of JSBSim's own scripts
MIN_RATE_HZ = 10.0  # below it the explicit integrators of JSBSim diverge on ordinary aircraft
# above it rounding of the step is all that is gained; the fastest own script runs at 1000 Hz
MAX_RATE_HZ = 10_000.0


@dataclass(frozen=True, slots=True)
class ScriptFlight(Flight):
    """A flight as a JSBSim script describes it (implements Flight).

    script: an XML file of root `runscript`, JSBSim's own or a user's. It names one of JSBSim's own
        aircraft, or one in `models`; its file of initial conditions may lie beside it, or with the
        aircraft.
    rate_hz: steps per second; None for the script's own.
    models: folder of a user's own aircraft (see `user_models.py`); None without.
    """

    live_only: ClassVar[str] = ""
    ends_itself: ClassVar[bool] = True

    script: Path
    rate_hz: float | None = None
    models: Path | None = None

    @property
    def name(self) -> str:
        """Name of the script, without its ending."""
        return self.script.name.removesuffix(".xml")

    def vehicle(self) -> Vehicle:
        """Load the script into JSBSim. Raises as `JsbsimVehicle`."""
        from .jsbsim_vehicle import JsbsimVehicle  # which flies what this module describes

        return JsbsimVehicle(self)

    def length(self) -> float | None:
        """Return the length that the script states, s; it may end earlier, or not load at all."""
        start, end, _ = script_run(self.script)
        return None if end is None else max(end - (start or 0.0), 0.0)

    def step(self) -> float:
        """Return the asked step or the script's own, s."""
        if self.rate_hz is not None:
            return 1.0 / self.rate_hz
        dt = script_run(self.script)[2]
        allowed = dt is not None and 1.0 / MAX_RATE_HZ <= dt <= 1.0 / MIN_RATE_HZ
        return dt if dt is not None and allowed else 1.0 / DEFAULT_RATE_HZ

    def files(self) -> dict[str, Path]:
        """Return a user's script, its initial conditions and its aircraft.

        Nothing of a script of JSBSim's own. Raises InputError for a file that cannot be read.
        """
        if self.script == own_scripts().get(self.script.stem):
            return {}
        content = read_users(self.script)
        files = {utf8(self.script.name): self.script}
        initialize, aircraft = _named(b"initialize", content), _named(b"aircraft", content)
        path = beside(self.script, initialize) if initialize else None
        files |= {path.name: path} if path else {}
        if aircraft and self.models and user_model(aircraft, self.models):
            files |= user_files(aircraft, self.models, "" if path else initialize)
        return files


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
    """A property of JSBSim that goes to a value at a time.

    From `time` (s) on, `property` goes to `value` (JSBSim's own unit), linearly within `ramp` (s)
    or at once when 0. A ramp starts from the property's value at that moment; of two on one
    property the later takes over from wherever it is.

    Inputs at time 0 are in effect before the first step and, without a ramp, during the trim and
    in the first state. So set wind, gear and flaps at 0, but begin a manoeuvre later: with the
    stick held over there is nothing to trim. Turbulence at 0 begins with the second state.
    """

    time: float
    property: str
    value: float
    ramp: float = 0.0


@dataclass(frozen=True, slots=True)
class AircraftFlight(Flight):
    """An aircraft flown by timed inputs (implements Flight).

    rate_hz: steps per second; None for DEFAULT_RATE_HZ.
    models: folder of the user that the aircraft is in (see `user_models.py`); None for one of
        JSBSim's own.
    """

    live_only: ClassVar[str] = ""
    ends_itself: ClassVar[bool] = False

    aircraft: str
    initial: InitialConditions
    inputs: tuple[TimedInput, ...] = ()
    rate_hz: float | None = None
    models: Path | None = None

    @property
    def name(self) -> str:
        """Name of the aircraft."""
        return plain_name(self.aircraft)

    def vehicle(self) -> Vehicle:
        """Load the aircraft into JSBSim. Raises as `JsbsimVehicle`."""
        from .jsbsim_vehicle import JsbsimVehicle  # which flies what this module describes

        return JsbsimVehicle(self)

    def length(self) -> None:
        """Return nothing: an aircraft flies on."""

    def step(self) -> float:
        """Return the asked step, s."""
        return 1.0 / (self.rate_hz or DEFAULT_RATE_HZ)

    def files(self) -> dict[str, Path]:
        """Return a user's aircraft with all files that it names; nothing of JSBSim's own.

        Raises InputError for too many files, and for one that cannot be read.
        """
        return user_files(self.aircraft, self.models) if self.models else {}


def _named(key: bytes, content: bytes) -> str:
    named = re.search(key + rb"\s*=\s*[\"']([\w./-]+)[\"']", content)
    return named[1].decode() if named else ""
