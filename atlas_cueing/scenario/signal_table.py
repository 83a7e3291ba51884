"""The `[vehicle]` table of test signals, with its `[[vehicle.signal]]` tables."""

from collections.abc import Collection
from math import radians
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, model_validator

from ..errors import InputError
from ..vehicles import Signal, SignalFlight
from ..vehicles.signal_shapes import DEFAULT_RAMP, FORCE_AXES, RATE_AXES, SHAPES, Shape, SignalAxis
from .mistakes import Key
from .source_table import SourceTable, tables
from .tables import ScenarioTable, number, object_to, refuse, says

Time: TypeAlias = Annotated[float, number(0.0, 86400.0)]  # s; a day
Frequency: TypeAlias = Annotated[float, number(0.001, 1000.0)]

# keys that a shape needs
_FREQUENCIES = {"sine": ("frequency_rad_s",), "sweep": ("frequency_rad_s", "end_frequency_rad_s")}


def _one_of(names: Collection[str]) -> BeforeValidator:
    """One of a few words."""

    def check(value: Any) -> str:
        """The word, or a refusal that names the allowed ones."""
        if not isinstance(value, str) or value not in names:
            raise refuse(", ".join(repr(name) for name in names))
        return value

    return BeforeValidator(check)


class SignalTable(ScenarioTable):
    """One `[[vehicle.signal]]`: see vehicles.Signal.

    Which keys an axis and a shape need, `signal_rules` checks.
    """

    axis: Annotated[
        SignalAxis,
        _one_of(RATE_AXES + FORCE_AXES),
        says("rate or force that the signal is added to, axes B"),
    ]
    shape: Annotated[Shape, _one_of(SHAPES), says("form of the signal over time")]
    amplitude_deg_s: Annotated[
        Annotated[float, number(-2500.0, 2500.0)] | None, says("largest value of a rate")
    ] = None
    amplitude_m_s2: Annotated[
        Annotated[float, number(-400.0, 400.0)] | None, says("largest value of a force")
    ] = None
    time_s: Annotated[Time, says("when it begins")] = 0.0
    duration_s: Annotated[float, number(0.0, 86400.0, above=True), says("how long it lasts")]
    ramp_s: Annotated[float, number(0.0, 86400.0, above=True), says("how long its edges take")] = (
        DEFAULT_RAMP
    )
    frequency_rad_s: Annotated[
        Frequency | None, says("frequency of a sine, first one of a sweep")
    ] = None
    end_frequency_rad_s: Annotated[Frequency | None, says("last frequency of a sweep")] = None

    @model_validator(mode="after")
    def _fits(self) -> "SignalTable":
        if all(getattr(self, key) is not None for key in _FREQUENCIES.get(self.shape, ())):
            try:
                self.signal().check()
            except InputError as error:
                raise object_to(str(error)) from None
        return self

    def signal(self) -> Signal:
        """Convert it to SI."""
        return Signal(
            axis=self.axis,
            shape=self.shape,
            amplitude=(
                radians(self.amplitude_deg_s or 0.0)
                if self.axis in RATE_AXES
                else self.amplitude_m_s2 or 0.0
            ),
            time=self.time_s,
            duration=self.duration_s,
            ramp=self.ramp_s,
            frequency=self.frequency_rad_s or 0.0,
            end_frequency=self.end_frequency_rad_s or 0.0,
        )


def signal_rules(signal: dict[str, Any]) -> list[tuple[str, str]]:
    """Missing and superfluous keys of one signal.

    None for an axis or shape that is a mistake itself.
    """
    axis, shape = signal.get("axis"), signal.get("shape")
    rules: list[tuple[str, bool, str]] = []  # key, whether it belongs here, and with what
    if axis in RATE_AXES + FORCE_AXES:
        rules.append(("amplitude_deg_s", axis in RATE_AXES, f"axis = {axis!r}"))
        rules.append(("amplitude_m_s2", axis in FORCE_AXES, f"axis = {axis!r}"))
    if shape in SHAPES:
        needed = _FREQUENCIES.get(str(shape), ())
        rules += [(key, key in needed, f"shape = {shape!r}") for key in _FREQUENCIES["sweep"]]
    wrong = [(key, belongs, owner) for key, belongs, owner in rules if (key in signal) != belongs]
    return [
        (key, f"missing, needed with {owner}" if belongs else f"not with {owner}")
        for key, belongs, owner in wrong
    ]


class SignalFlightTable(SourceTable):
    """`[vehicle]` of test signals, at least one."""

    source: Annotated[Literal["signal"], says("flies signals that are made up")] = "signal"
    rate_hz: Annotated[Annotated[float, number(10.0, 1000.0)] | None, says("states a second")] = (
        None
    )
    signal: Annotated[tuple[SignalTable, ...], tables("signal")] | None = None
    force_follows_attitude: Annotated[
        bool | None, says("whether gravity turns with the attitude that the rates make")
    ] = None

    def flight(self, folder: Path) -> SignalFlight:
        """Return the signals in SI."""
        _ = folder
        signals = tuple(table.signal() for table in self.signal or ())
        return SignalFlight(signals, self.rate_hz, self.force_follows_attitude is not False)

    @classmethod
    def rules(cls, vehicle: dict[str, Any], data: dict[str, Any]) -> list[tuple[Key, str]]:
        """Find missing and superfluous keys of each signal."""
        _ = data
        signals = vehicle.get("signal", [])
        if signals == []:
            return [(("vehicle", "signal"), "missing, at least one [[vehicle.signal]]")]
        return [
            (("vehicle", "signal", i, key), allowed)
            for i, signal in enumerate(signals if isinstance(signals, list) else ())
            if isinstance(signal, dict)
            for key, allowed in signal_rules(signal)
        ]
