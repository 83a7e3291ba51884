"""The `[vehicle]` table: a JSBSim script, or an aircraft with initial conditions and timed inputs."""

from collections.abc import Collection
from math import radians
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, Field, ValidationInfo

from ..vehicles import AircraftFlight, InitialConditions, ScriptFlight, TimedInput, own_aircraft, own_scripts
from .mistakes import nearest
from .table import Finite, Table, number, refuse, text

Flight: TypeAlias = ScriptFlight | AircraftFlight
Time: TypeAlias = Annotated[float, number(0.0, 86400.0)]  # s; a day

_LONGEST_PROPERTY = 200  # characters; the longest of JSBSim's own has 70


def _known_source(value: Any) -> str:
    if value in ("flightgear", "recording"):
        raise refuse("only 'jsbsim' flies in batch runs")
    if value != "jsbsim":
        raise refuse("'jsbsim'")
    return "jsbsim"


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


def _as_tuple(value: Any) -> Any:
    if not isinstance(value, list | tuple):
        raise refuse("tables, written [[vehicle.input]]")
    return tuple(value)


class VehicleTable(Table):
    """`[vehicle]`: exactly one of `script` and `aircraft`, which `vehicle_rules` checks."""

    source: Annotated[str, BeforeValidator(_known_source)] = "jsbsim"
    script: Annotated[str, BeforeValidator(_known_script)] | None = None
    aircraft: Annotated[str, BeforeValidator(_known_aircraft)] | None = None
    rate_hz: Annotated[float, number(10.0, 1000.0)] | None = None
    initial: InitialTable | None = None
    input: Annotated[tuple[InputTable, ...], BeforeValidator(_as_tuple)] = Field(default=())

    def user_script(self, folder: Path) -> Path | None:
        """The script file beside the scenario; None for one of JSBSim's own and for an aircraft."""
        return script_beside(self.script, folder) if self.script is not None and self.script not in own_scripts() else None

    def flight(self, duration: float | None, folder: Path) -> Flight:
        """What to fly, for `duration` s; a user's script is looked for in `folder`."""
        if self.script is not None:
            script = self.user_script(folder) or own_scripts()[self.script]
            return ScriptFlight(script, self.rate_hz, duration)
        assert self.aircraft is not None and self.initial is not None  # noqa: S101, PT018 - vehicle_rules
        inputs = tuple(event.event() for event in self.input)
        return AircraftFlight(self.aircraft, self.initial.conditions(), inputs, self.rate_hz, duration)


def vehicle_rules(data: dict[str, Any]) -> list[tuple[tuple[str, ...], str]]:
    """What goes with what in a scenario's tables: (key, what is allowed) for each mistake."""
    vehicle = data.get("vehicle")
    if not isinstance(vehicle, dict):
        return []
    if ("script" in vehicle) == ("aircraft" in vehicle):
        return [(("vehicle",), "exactly one of script and aircraft")]
    if "script" in vehicle:
        return [(("vehicle", key), "not with script, which has its own") for key in ("initial", "input") if key in vehicle]
    mistakes: list[tuple[tuple[str, ...], str]] = []
    if "initial" not in vehicle:
        mistakes.append((("vehicle", "initial"), "missing, an aircraft needs initial conditions"))
    if "duration_s" not in data:
        mistakes.append((("duration_s",), "missing, an aircraft flight has no end of its own"))
    return mistakes
