"""The `[vehicle]` table of JSBSim: a script, or an aircraft with initial conditions and inputs."""

from collections.abc import Collection
from math import radians
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, ValidationInfo

from ..errors import StartError
from ..printable import is_name, utf8
from ..vehicles import (
    AircraftFlight,
    InitialConditions,
    ScriptFlight,
    TimedInput,
    input_objections,
    own_aircraft,
    own_scripts,
)
from ..vehicles.jsbsim.loading import AIRCRAFT_KEY
from ..vehicles.jsbsim.user_models import aircraft_objection, user_model, within
from .mistakes import MOST_SHOWN, Key, nearest, shown
from .signal_table import Time
from .source_table import MOST_TABLES, SourceTable, tables
from .tables import Finite, ScenarioTable, number, object_to, refuse, says, text

_LONGEST_PROPERTY = 200  # characters; the longest of JSBSim's own has 70


def _known(kind: str, names: Collection[str], value: Any) -> str:
    if not isinstance(value, str) or value not in names:
        raise refuse(f"one of JSBSim's own {kind}; {nearest(str(value), names)}")
    return value


def _known_aircraft(value: Any, info: ValidationInfo) -> str:
    """Read a name; a number is one too.

    `--set vehicle.aircraft=737` and 737 without quotes mean nothing else.
    """
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

    altitude_m: Annotated[float, number(-500.0, 1e7), says("height above the sea at the start")]
    airspeed_m_s: Annotated[float, number(0.0, 2e4), says("true airspeed at the start")]
    heading_deg: Annotated[
        float, number(-360.0, 360.0), says("heading at the start, from north")
    ] = 0.0
    pitch_deg: Annotated[float, number(-90.0, 90.0), says("pitch at the start, nose up")] = 0.0
    roll_deg: Annotated[float, number(-360.0, 360.0), says("roll at the start, to the right")] = 0.0
    latitude_deg: Annotated[float, number(-90.0, 90.0), says("geodetic latitude at the start")] = (
        0.0
    )
    longitude_deg: Annotated[float, number(-360.0, 360.0), says("longitude at the start")] = 0.0
    engines_running: Annotated[bool, says("whether the engines run at the start")] = True
    trim: Annotated[bool, says("look for a steady state before the start")] = False

    def conditions(self) -> InitialConditions:
        """Convert it to SI."""
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

    time_s: Annotated[Time, says("when the property begins to change")]
    property: Annotated[
        str,
        text("name of a JSBSim property", lambda name: 0 < len(name) <= _LONGEST_PROPERTY),
        says("JSBSim property that is set"),
    ]
    value: Annotated[Finite, says("what the property becomes")]
    ramp_s: Annotated[Time, says("how long that takes; 0: at once")] = 0.0

    def event(self) -> TimedInput:
        """Convert it to SI."""
        return TimedInput(self.time_s, self.property, self.value, self.ramp_s)


class JsbsimTable(SourceTable):
    """`[vehicle]` of JSBSim: exactly one of `script` and `aircraft`, which `rules` checks."""

    source: Annotated[Literal["jsbsim"], says("flies JSBSim's model of an aircraft")] = "jsbsim"
    script: Annotated[
        Annotated[str, BeforeValidator(_known_script)] | None,
        says("JSBSim script to fly; or aircraft"),
    ] = None
    aircraft: Annotated[
        Annotated[str, BeforeValidator(_known_aircraft)] | None, says("aircraft to fly; or script")
    ] = None
    rate_hz: Annotated[Annotated[float, number(10.0, 1000.0)] | None, says("states a second")] = (
        None
    )
    initial: InitialTable | None = None
    input: Annotated[tuple[InputTable, ...], tables("input")] = Field(default=())

    @property
    def flown(self) -> str:
        """The script or the aircraft."""
        return self.script or self.aircraft or self.source

    def flight(self, folder: Path) -> ScriptFlight | AircraftFlight:
        """Return what to fly; a user's script or aircraft lies in `folder`."""
        models = folder if self.program(folder) else None
        if self.script is not None:
            script = self.user_script(folder) or own_scripts()[self.script]
            return ScriptFlight(script, self.rate_hz, models)
        assert self.aircraft is not None and self.initial is not None  # noqa: S101, PT018 - rules
        inputs = tuple(event.event() for event in self.input)
        return AircraftFlight(
            self.aircraft, self.initial.conditions(), inputs, self.rate_hz, models
        )

    def program(self, folder: Path) -> tuple[str, Path] | None:
        """Return a user's script or aircraft: it can hold whatever JSBSim understands."""
        script, model = self.user_script(folder), self._user_aircraft(folder)
        if script:
            return "script", script
        return ("aircraft", model) if model else None

    def portable(self, folder: Path) -> dict[str, Any]:
        """Return the table, a user's script by its name alone."""
        table = super().portable(folder)
        if not self.input:
            del table["input"]  # a script must not have any
        script = self.user_script(folder)
        if script is not None:
            table["script"] = f"./{utf8(script.name)}"  # never mistaken for one of JSBSim's own
        return table

    def user_script(self, folder: Path) -> Path | None:
        """Return the script beside the scenario; None for JSBSim's own and for an aircraft."""
        own = self.script is None or self.script in own_scripts()
        return None if own else within(folder, self.script or "")

    def _user_aircraft(self, folder: Path) -> Path | None:
        mine = self.aircraft is not None and self.aircraft not in own_aircraft()
        return user_model(self.aircraft or "", folder) if mine else None

    @classmethod
    def rules(cls, vehicle: dict[str, Any], data: dict[str, Any]) -> list[tuple[Key, str]]:
        """Find what does not go with a script, or is missing with an aircraft."""
        if ("script" in vehicle) == ("aircraft" in vehicle):
            return [(("vehicle",), "exactly one of script and aircraft")]
        if "script" in vehicle:
            return [
                (("vehicle", key), "not with script, which has its own")
                for key in ("initial", "input")
                if key in vehicle
            ]
        initial = (("vehicle", "initial"), "missing, an aircraft needs initial conditions")
        duration = (("duration_s",), "missing, an aircraft flight has no end of its own")
        return [
            *([] if "initial" in vehicle else [initial]),
            *([] if "duration_s" in data else [duration]),
        ]


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
        or len(inputs) > MOST_TABLES
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
    """Property of an input, checked or not; nothing when it has none that can be one."""
    if isinstance(event, InputTable):
        return event.property
    name = event.get("property") if isinstance(event, dict) else None
    return name if isinstance(name, str) and len(name) <= _LONGEST_PROPERTY else ""
