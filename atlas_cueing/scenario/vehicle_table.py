"""The `[vehicle]` table: a JSBSim script, an aircraft with initial conditions and timed inputs, or test signals.

Two sources fly only live: `flightgear`, a simulator that sends packets to a port here, and
    `recording`, a log played back.
"""

from collections.abc import Collection
from ipaddress import AddressValueError, IPv4Address
from math import radians
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, Field, ValidationInfo

from ..errors import InputError, StartError
from ..printable import is_name
from ..vehicles import (
    AircraftFlight,
    FlightgearFlight,
    InitialConditions,
    ScriptFlight,
    SignalFlight,
    TimedInput,
    input_objections,
    own_aircraft,
    own_scripts,
)
from ..vehicles.flightgear import DEFAULT_PORT, DEFAULT_RATE_HZ, LOOPBACK
from ..vehicles.jsbsim.loading import AIRCRAFT_KEY
from ..vehicles.jsbsim.user_models import aircraft_objection, user_model, within
from .mistakes import MOST_SHOWN, Key, nearest, shown
from .recorded import RecordedFlight
from .signal_table import SignalTable, Time, signal_rules
from .tables import Finite, ScenarioTable, number, object_to, refuse, text, whole

Flight: TypeAlias = ScriptFlight | AircraftFlight | SignalFlight
LiveFlight: TypeAlias = Flight | FlightgearFlight | RecordedFlight

_LONGEST_PROPERTY = 200  # characters; the longest of JSBSim's own has 70
_MOST_TABLES = 5000  # of one kind; as many inputs as the largest file holds
_LONGEST_PATH = 4096  # characters

_JSBSIM, _SIGNAL, _FLIGHTGEAR, _RECORDING = "jsbsim", "signal", "flightgear", "recording"
_KEYS = {  # of each source, and of no other; those of two sources are in both
    _JSBSIM: ("script", "aircraft", "initial", "input", "rate_hz"),
    _SIGNAL: ("signal", "force_follows_attitude", "rate_hz"),
    _FLIGHTGEAR: ("host", "port", "rate_hz"),
    _RECORDING: ("log",),
}
_ONLY_LIVE = {
    _FLIGHTGEAR: "source = 'flightgear' flies only live: atlas-cueing live FILE",
    _RECORDING: (
        "source = 'recording' flies only live: atlas-cueing live FILE; without a clock:"
        " atlas-cueing recue LOG"
    ),
}


def _known_source(value: Any) -> str:
    if not isinstance(value, str) or value not in _KEYS:
        raise refuse(", ".join(repr(source) for source in _KEYS))
    return value


def _loopback(value: Any) -> str:
    try:
        if isinstance(value, str) and IPv4Address(value).is_loopback:
            return value
    except AddressValueError:
        pass
    raise refuse(
        f"{LOOPBACK!r} or another loopback address; packets from other machines are not taken yet"
    )


def _known(kind: str, names: Collection[str], value: Any) -> str:
    if not isinstance(value, str) or value not in names:
        raise refuse(f"one of JSBSim's own {kind}; {nearest(str(value), names)}")
    return value


def _known_aircraft(value: Any, info: ValidationInfo) -> str:
    """A name; so is a number, for `--set vehicle.aircraft=737` and 737 without quotes mean nothing else."""
    name = str(value) if isinstance(value, int) and not isinstance(value, bool) else value
    kind = "aircraft, or one in aircraft/NAME/NAME.xml beside the scenario"
    if not isinstance(name, str):
        return _known(kind, own_aircraft(), name)
    objection = aircraft_objection(name, (info.context or {})["folder"])
    if objection and name in own_aircraft():
        raise object_to(objection)
    return _known(kind, own_aircraft(), name) if objection else name


def _known_script(value: Any, info: ValidationInfo) -> str:
    if isinstance(value, str) and value in own_scripts():
        return value
    folder: Path = (info.context or {})["folder"]
    if isinstance(value, str) and is_name(value) and within(folder, value):
        return value
    return _known(
        "scripts, or a file in the scenario's folder (links resolved)", own_scripts(), value
    )


class InitialTable(ScenarioTable):
    """`[vehicle.initial]`: see vehicles.InitialConditions."""

    altitude_m: Annotated[float, number(-500.0, 1e7)]
    airspeed_m_s: Annotated[float, number(0.0, 2e4)]
    heading_deg: Annotated[float, number(-360.0, 360.0)] = 0.0
    pitch_deg: Annotated[float, number(-90.0, 90.0)] = 0.0
    roll_deg: Annotated[float, number(-360.0, 360.0)] = 0.0
    latitude_deg: Annotated[float, number(-90.0, 90.0)] = 0.0
    longitude_deg: Annotated[float, number(-360.0, 360.0)] = 0.0
    engines_running: bool = True
    trim: bool = False

    def conditions(self) -> InitialConditions:
        """The same in SI."""
        return InitialConditions(
            altitude=self.altitude_m,
            airspeed=self.airspeed_m_s,
            heading=radians(self.heading_deg),
            pitch=radians(self.pitch_deg),
            roll=radians(self.roll_deg),
            latitude=radians(self.latitude_deg),
            longitude=radians(self.longitude_deg),
            engines_running=self.engines_running,
            trim=self.trim,
        )


class InputTable(ScenarioTable):
    """One `[[vehicle.input]]`: see vehicles.TimedInput."""

    time_s: Time
    property: Annotated[
        str, text("name of a JSBSim property", lambda name: 0 < len(name) <= _LONGEST_PROPERTY)
    ]
    value: Finite
    ramp_s: Time = 0.0

    def event(self) -> TimedInput:
        """The same in SI."""
        return TimedInput(self.time_s, self.property, self.value, self.ramp_s)


def _tables(name: str) -> BeforeValidator:
    """A list of tables."""

    def check(value: Any) -> Any:
        """The tables, or a refusal that tells how they are written."""
        if not isinstance(value, list | tuple):
            raise refuse(f"tables, written [[vehicle.{name}]]")
        if len(value) > _MOST_TABLES:
            raise object_to(
                f"{len(value)} tables [[vehicle.{name}]], allowed: at most {_MOST_TABLES}"
            )
        return tuple(value)

    return BeforeValidator(check)


class VehicleTable(ScenarioTable):
    """`[vehicle]`: a source and its own keys, which `vehicle_rules` checks.

    Exactly one of `script` and `aircraft`, ...

    host, port: where packets of a `flightgear` source come in; rate_hz: how many a second,
        nominally.
    log: the log (MCAP) that a `recording` plays, from the scenario's folder; anywhere, for it is
        data, as a platform file is.
    """

    source: Annotated[str, BeforeValidator(_known_source)] = _JSBSIM
    script: Annotated[str, BeforeValidator(_known_script)] | None = None
    aircraft: Annotated[str, BeforeValidator(_known_aircraft)] | None = None
    rate_hz: Annotated[float, number(10.0, 1000.0)] | None = None
    initial: InitialTable | None = None
    input: Annotated[tuple[InputTable, ...], _tables("input")] = Field(default=())
    signal: Annotated[tuple[SignalTable, ...], _tables("signal")] | None = None
    force_follows_attitude: bool | None = None
    host: Annotated[str, BeforeValidator(_loopback)] | None = None
    port: Annotated[int, whole(1, 65535)] | None = None
    log: (
        Annotated[
            str, text("path of a log", lambda path: is_name(path) and len(path) <= _LONGEST_PATH)
        ]
        | None
    ) = None

    def user_script(self, folder: Path) -> Path | None:
        """The script file beside the scenario; None for one of JSBSim's own and for an aircraft."""
        return (
            within(folder, self.script)
            if self.script is not None and self.script not in own_scripts()
            else None
        )

    def user_aircraft(self, folder: Path) -> Path | None:
        """The model beside the scenario; None for one of JSBSim's own and for a script."""
        mine = self.aircraft is not None and self.aircraft not in own_aircraft()
        return user_model(self.aircraft or "", folder) if mine else None

    def flight(self, duration: float | None, folder: Path) -> Flight:
        """What to fly without a clock, for `duration` s; a user's script is looked for in `folder`.

        Raises InputError for a source that flies only live.
        """
        if self.source in _ONLY_LIVE:
            raise InputError(_ONLY_LIVE[self.source])
        if self.source == _SIGNAL:
            signals = tuple(table.signal() for table in self.signal or ())
            return SignalFlight(
                signals, self.rate_hz, duration, self.force_follows_attitude is not False
            )
        if self.script is not None:
            mine = self.user_script(folder)
            script = mine or own_scripts()[self.script]
            return ScriptFlight(script, self.rate_hz, duration, folder if mine else None)
        # Vehicle_rules
        assert self.aircraft is not None and self.initial is not None  # noqa: S101, PT018
        inputs = tuple(event.event() for event in self.input)
        initial, models = self.initial.conditions(), folder if self.user_aircraft(folder) else None
        return AircraftFlight(self.aircraft, initial, inputs, self.rate_hz, duration, models)

    def live_flight(self, duration: float | None, folder: Path) -> LiveFlight:
        """What to fly in real time; `folder` is also where a log is looked for."""
        if self.source == _FLIGHTGEAR:
            return FlightgearFlight(
                self.host or LOOPBACK, self.port or DEFAULT_PORT, self.rate_hz or DEFAULT_RATE_HZ
            )
        if self.source == _RECORDING:
            assert self.log is not None  # noqa: S101 - vehicle_rules
            return RecordedFlight(folder / self.log)
        return self.flight(duration, folder)


def vehicle_rules(data: dict[str, Any]) -> list[tuple[Key, str]]:
    """What goes with what in a scenario's tables: (key, what is allowed) for each mistake."""
    vehicle = data.get("vehicle")
    if not isinstance(vehicle, dict):
        return []
    source = vehicle.get("source", _JSBSIM)
    if not isinstance(source, str) or source not in _KEYS:
        return []  # a mistake of its own; what belongs together nobody knows without it
    mistakes = _strangers(vehicle, source)
    if source == _JSBSIM:
        mistakes += _jsbsim_rules(data, vehicle)
    elif source == _SIGNAL:
        mistakes += _signal_flight_rules(vehicle)
    elif source == _RECORDING and "log" not in vehicle:
        mistakes.append((("vehicle", "log"), "missing, the log that is played"))
    return mistakes


def unsettable_inputs(
    data: dict[str, Any], folder: Path, trusted: bool
) -> list[tuple[Key, str, str]]:
    """Inputs on properties that cannot be set, or are none: (key, value, what is wrong) for each.

    An aircraft that does not load is a mistake itself. One of the user's own is looked at only when
    it is trusted, and none without inputs.
    """
    vehicle = data.get("vehicle")
    inputs = vehicle.get("input") if isinstance(vehicle, dict) else None
    if (
        not isinstance(vehicle, dict)
        or not isinstance(inputs, list | tuple)
        or len(inputs) > _MOST_TABLES
    ):
        return []
    aircraft = str(vehicle.get("aircraft", ""))
    mine = aircraft not in own_aircraft()
    if aircraft_objection(aircraft, folder) or (mine and not trusted):
        return []
    names = {i: name for i, event in enumerate(inputs) if (name := _property(event))}
    try:
        wrong = (
            input_objections(aircraft, folder if mine else None, names.values()) if names else {}
        )
    except StartError as error:
        reason = str(error).removeprefix(f"{AIRCRAFT_KEY} = {aircraft!r}: ")
        return [(("vehicle", AIRCRAFT_KEY), shown(aircraft), reason)]
    found = [(i, name) for i, name in names.items() if name in wrong][:MOST_SHOWN]
    return [(("vehicle", "input", i, "property"), shown(name), wrong[name]) for i, name in found]


def _property(event: Any) -> str:
    """Of an input, checked or not; nothing when it has none that can be one."""
    if isinstance(event, InputTable):
        return event.property
    name = event.get("property") if isinstance(event, dict) else None
    return name if isinstance(name, str) and len(name) <= _LONGEST_PROPERTY else ""


def _strangers(vehicle: dict[str, Any], source: str) -> list[tuple[Key, str]]:
    """Keys that belong to other sources: named are those of a source of one's own, or else the source itself."""
    mistakes: list[tuple[Key, str]] = []
    for key in [
        key
        for key in dict.fromkeys(sum(_KEYS.values(), ()))
        if key in vehicle and key not in _KEYS[source]
    ]:
        owners = [owner for owner, keys in _KEYS.items() if key in keys]
        only = source == _JSBSIM and len(owners) == 1
        mistakes.append(
            (
                ("vehicle", key),
                f"only with source = {owners[0]!r}" if only else f"not with source = {source!r}",
            )
        )
    return mistakes


def _jsbsim_rules(data: dict[str, Any], vehicle: dict[str, Any]) -> list[tuple[Key, str]]:
    if ("script" in vehicle) == ("aircraft" in vehicle):
        return [(("vehicle",), "exactly one of script and aircraft")]
    if "script" in vehicle:
        return [
            (("vehicle", key), "not with script, which has its own")
            for key in ("initial", "input")
            if key in vehicle
        ]
    mistakes: list[tuple[Key, str]] = []
    if "initial" not in vehicle:
        mistakes.append((("vehicle", "initial"), "missing, an aircraft needs initial conditions"))
    if "duration_s" not in data:
        mistakes.append((("duration_s",), "missing, an aircraft flight has no end of its own"))
    return mistakes


def _signal_flight_rules(vehicle: dict[str, Any]) -> list[tuple[Key, str]]:
    mistakes: list[tuple[Key, str]] = []
    signals = vehicle.get("signal", [])
    if signals == []:
        mistakes.append((("vehicle", "signal"), "missing, at least one [[vehicle.signal]]"))
    each = enumerate(signals) if isinstance(signals, list) else ()
    for i, signal in each:
        if isinstance(signal, dict):
            mistakes += [
                (("vehicle", "signal", i, key), allowed) for key, allowed in signal_rules(signal)
            ]
    return mistakes
