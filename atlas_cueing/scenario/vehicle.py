"""The `[vehicle]` table: a JSBSim script, an aircraft with initial conditions and timed inputs, or test signals."""

from collections.abc import Collection
from math import radians
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, Field, ValidationInfo, model_validator

from ..errors import InputError
from ..vehicles import (
    AircraftFlight,
    InitialConditions,
    ScriptFlight,
    Signal,
    SignalFlight,
    TimedInput,
    own_aircraft,
    own_scripts,
)
from ..vehicles.signal import DEFAULT_RAMP, FORCE_AXES, RATE_AXES, SHAPES, Axis, Shape
from .mistakes import Key, nearest
from .table import Finite, Table, number, object_to, refuse, text

Flight: TypeAlias = ScriptFlight | AircraftFlight | SignalFlight
Time: TypeAlias = Annotated[float, number(0.0, 86400.0)]  # s; a day
Frequency: TypeAlias = Annotated[float, number(0.001, 1000.0)]

_LONGEST_PROPERTY = 200  # characters; the longest of JSBSim's own has 70


_SIGNAL = "signal"
_SOURCES = ("jsbsim", _SIGNAL)
_SIGNAL_KEYS = ("signal", "force_follows_attitude")
_FREQUENCIES = {"sine": ("frequency_rad_s",), "sweep": ("frequency_rad_s", "end_frequency_rad_s")}  # keys that a shape needs


def _known_source(value: Any) -> str:
    if value in ("flightgear", "recording"):
        raise refuse("only 'jsbsim' and 'signal' fly in batch runs")
    if value not in _SOURCES:
        raise refuse("'jsbsim', 'signal'")
    return str(value)


def _known(kind: str, names: Collection[str], value: Any) -> str:
    if not isinstance(value, str) or value not in names:
        raise refuse(f"one of JSBSim's own {kind}; {nearest(str(value), names)}")
    return value


def _known_aircraft(value: Any) -> str:
    return _known("aircraft", own_aircraft(), value)


def _known_script(value: Any, info: ValidationInfo) -> str:
    if isinstance(value, str) and value in own_scripts():
        return value
    folder: Path = (info.context or {})["folder"]
    if isinstance(value, str) and script_beside(value, folder):
        return value
    return _known("scripts, or a file in the scenario's folder (links resolved)", own_scripts(), value)


def script_beside(name: str, folder: Path) -> Path | None:
    """The user's script file, if it lies within the scenario's folder when all links are resolved."""
    try:
        path = (folder / name).resolve()
        return path if path.is_file() and path.is_relative_to(folder.resolve()) else None
    except (OSError, ValueError):  # ValueError: a NUL in the name
        return None


class InitialTable(Table):
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


class InputTable(Table):
    """One `[[vehicle.input]]`: see vehicles.TimedInput."""

    time_s: Time
    property: Annotated[str, text("name of a JSBSim property", lambda name: 0 < len(name) <= _LONGEST_PROPERTY)]
    value: Finite
    ramp_s: Time = 0.0

    def event(self) -> TimedInput:
        """The same in SI."""
        return TimedInput(self.time_s, self.property, self.value, self.ramp_s)


def _one_of(names: Collection[str]) -> BeforeValidator:
    """One of a few words."""

    def check(value: Any) -> str:
        if not isinstance(value, str) or value not in names:
            raise refuse(", ".join(repr(name) for name in names))
        return value

    return BeforeValidator(check)


class SignalTable(Table):
    """One `[[vehicle.signal]]`: see vehicles.Signal. Which keys an axis and a shape need, `vehicle_rules` checks."""

    axis: Annotated[Axis, _one_of(RATE_AXES + FORCE_AXES)]
    shape: Annotated[Shape, _one_of(SHAPES)]
    amplitude_deg_s: Annotated[float, number(-2500.0, 2500.0)] | None = None
    amplitude_m_s2: Annotated[float, number(-400.0, 400.0)] | None = None
    time_s: Time = 0.0
    duration_s: Annotated[float, number(0.0, 86400.0, above=True)]
    ramp_s: Annotated[float, number(0.0, 86400.0, above=True)] = DEFAULT_RAMP
    frequency_rad_s: Frequency | None = None
    end_frequency_rad_s: Frequency | None = None

    @model_validator(mode="after")
    def _fits(self) -> "SignalTable":
        if all(getattr(self, key) is not None for key in _FREQUENCIES.get(self.shape, ())):
            try:
                self.signal().check()
            except InputError as error:
                raise object_to(str(error)) from None
        return self

    def signal(self) -> Signal:
        """The same in SI."""
        return Signal(
            axis=self.axis,
            shape=self.shape,
            amplitude=radians(self.amplitude_deg_s or 0.0) if self.axis in RATE_AXES else self.amplitude_m_s2 or 0.0,
            time=self.time_s,
            duration=self.duration_s,
            ramp=self.ramp_s,
            frequency=self.frequency_rad_s or 0.0,
            end_frequency=self.end_frequency_rad_s or 0.0,
        )


def _tables(name: str) -> BeforeValidator:
    """A list of tables."""

    def check(value: Any) -> Any:
        if not isinstance(value, list | tuple):
            raise refuse(f"tables, written [[vehicle.{name}]]")
        return tuple(value)

    return BeforeValidator(check)


class VehicleTable(Table):
    """`[vehicle]`: exactly one of `script`, `aircraft` and, with its own source, `signal`, which `vehicle_rules` checks."""

    source: Annotated[str, BeforeValidator(_known_source)] = "jsbsim"
    script: Annotated[str, BeforeValidator(_known_script)] | None = None
    aircraft: Annotated[str, BeforeValidator(_known_aircraft)] | None = None
    rate_hz: Annotated[float, number(10.0, 1000.0)] | None = None
    initial: InitialTable | None = None
    input: Annotated[tuple[InputTable, ...], _tables("input")] = Field(default=())
    signal: Annotated[tuple[SignalTable, ...], _tables("signal")] | None = None
    force_follows_attitude: bool | None = None

    def user_script(self, folder: Path) -> Path | None:
        """The script file beside the scenario; None for one of JSBSim's own and for an aircraft."""
        return script_beside(self.script, folder) if self.script is not None and self.script not in own_scripts() else None

    def flight(self, duration: float | None, folder: Path) -> Flight:
        """What to fly, for `duration` s; a user's script is looked for in `folder`."""
        if self.source == _SIGNAL:
            signals = tuple(table.signal() for table in self.signal or ())
            return SignalFlight(signals, self.rate_hz, duration, self.force_follows_attitude is not False)
        if self.script is not None:
            script = self.user_script(folder) or own_scripts()[self.script]
            return ScriptFlight(script, self.rate_hz, duration)
        assert self.aircraft is not None and self.initial is not None  # noqa: S101, PT018 - vehicle_rules
        inputs = tuple(event.event() for event in self.input)
        return AircraftFlight(self.aircraft, self.initial.conditions(), inputs, self.rate_hz, duration)


def vehicle_rules(data: dict[str, Any]) -> list[tuple[Key, str]]:
    """What goes with what in a scenario's tables: (key, what is allowed) for each mistake."""
    vehicle = data.get("vehicle")
    if not isinstance(vehicle, dict):
        return []
    if vehicle.get("source") == _SIGNAL:
        return _signal_flight_rules(vehicle)
    only = f"only with source = {_SIGNAL!r}"
    strangers: list[tuple[Key, str]] = [(("vehicle", key), only) for key in _SIGNAL_KEYS if key in vehicle]
    return strangers + _jsbsim_rules(data, vehicle)


def _jsbsim_rules(data: dict[str, Any], vehicle: dict[str, Any]) -> list[tuple[Key, str]]:
    if ("script" in vehicle) == ("aircraft" in vehicle):
        return [(("vehicle",), "exactly one of script and aircraft")]
    if "script" in vehicle:
        return [(("vehicle", key), "not with script, which has its own") for key in ("initial", "input") if key in vehicle]
    mistakes: list[tuple[Key, str]] = []
    if "initial" not in vehicle:
        mistakes.append((("vehicle", "initial"), "missing, an aircraft needs initial conditions"))
    if "duration_s" not in data:
        mistakes.append((("duration_s",), "missing, an aircraft flight has no end of its own"))
    return mistakes


def _signal_flight_rules(vehicle: dict[str, Any]) -> list[tuple[Key, str]]:
    mistakes: list[tuple[Key, str]] = [
        (("vehicle", key), f"not with source = {_SIGNAL!r}")
        for key in ("script", "aircraft", "initial", "input")
        if key in vehicle
    ]
    signals = vehicle.get("signal", [])
    if signals == []:
        mistakes.append((("vehicle", "signal"), "missing, at least one [[vehicle.signal]]"))
    each = enumerate(signals) if isinstance(signals, list) else ()
    for i, signal in each:
        if isinstance(signal, dict):
            mistakes += [(("vehicle", "signal", i, key), allowed) for key, allowed in _signal_rules(signal)]
    return mistakes


def _signal_rules(signal: dict[str, Any]) -> list[tuple[str, str]]:
    """Missing and superfluous keys of one signal; none for an axis or shape that is a mistake itself."""
    axis, shape = signal.get("axis"), signal.get("shape")
    rules: list[tuple[str, bool, str]] = []  # key, whether it belongs here, and with what
    if axis in RATE_AXES + FORCE_AXES:
        rules.append(("amplitude_deg_s", axis in RATE_AXES, f"axis = {axis!r}"))
        rules.append(("amplitude_m_s2", axis in FORCE_AXES, f"axis = {axis!r}"))
    if shape in SHAPES:
        needed = _FREQUENCIES.get(str(shape), ())
        rules += [(key, key in needed, f"shape = {shape!r}") for key in _FREQUENCIES["sweep"]]
    wrong = [(key, belongs, owner) for key, belongs, owner in rules if (key in signal) != belongs]
    return [(key, f"missing, needed with {owner}" if belongs else f"not with {owner}") for key, belongs, owner in wrong]
