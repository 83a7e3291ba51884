"""A parameter that a user can choose: its key in a file, where it goes, its range and its source.

The number in a file has the unit that ends its key; the code computes in SI and rad. Both ways of
that conversion are here.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import degrees, isinf, radians
from operator import attrgetter
from typing import Any, TypeAlias, TypeVar, cast

from ..rotation import Vec3

T = TypeVar("T")
Value: TypeAlias = float | Vec3 | str

ONES: Vec3 = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of a file, by its symbol; of an angle or a rate `in_degrees` the code has radians."""

    symbol: str
    in_degrees: bool = False

    def to_si(self, value: float) -> float:
        """Convert a number of a file to the unit of the code."""
        return radians(value) if self.in_degrees else value

    def from_si(self, value: float) -> float:
        """Convert a number of the code to the unit of the file.

        Degrees lose the rounding of their last digits, so that 3 deg/s reads 3.0 and goes back to
        the same radians.
        """
        return round(degrees(value), 12) if self.in_degrees else value


DIMENSIONLESS = Unit("")
UNITS = {  # by the end of the key, the longer ends first
    "_deg_s": Unit("deg/s", in_degrees=True),
    "_rad_s": Unit("rad/s"),
    "_m_s2": Unit("m/s^2"),
    "_m_s": Unit("m/s"),
    "_per_s": Unit("1/s"),
    "_deg": Unit("deg", in_degrees=True),
    "_rad": Unit("rad"),
    "_hz": Unit("Hz"),
    "_m": Unit("m"),
    "_s": Unit("s"),
}


@dataclass(frozen=True, slots=True)
class Range:
    """Numbers from `lower` to `upper`, in the unit of the file; `above`: without `lower` itself."""

    lower: float
    upper: float
    above: bool = False

    def __str__(self) -> str:
        return f"{self.lower:g} {'<' if self.above else '<='} value <= {self.upper:g}"


@dataclass(frozen=True, slots=True)
class Choice:
    """One of some words."""

    words: tuple[str, ...]

    def __str__(self) -> str:
        return " or ".join(self.words)


@dataclass(frozen=True, slots=True)
class Switch:
    """True or false."""

    def __str__(self) -> str:
        return "true or false"


@dataclass(frozen=True, slots=True)
class Parameter:
    """One key of a file.

    key: its name there, which ends with its unit.
    field: the attribute of the parameters' dataclass that takes the value; `turn.rate` lies in a
        dataclass within.
    allowed: the range of a number (of each of three, where the default is a vector), or the words.
    description: one line on what it does.
    source: where the default comes from; "assumed" or "found" (by trials) where there is no source.
    """

    key: str
    field: str
    allowed: Range | Choice | Switch
    description: str
    source: str

    @property
    def unit(self) -> Unit:
        """The unit that the key ends with."""
        ends = (unit for end, unit in UNITS.items() if self.key.endswith(end))
        return next(ends, DIMENSIONLESS)

    def default(self, defaults: object) -> Value | None:
        """Read the value that the parameters `defaults` have for this key, in the file's unit.

        It is None where they set no bound, an infinite number: that is written by leaving the key
        out.
        """
        value = self._read(defaults)
        if isinstance(value, tuple):
            return None if isinf(max(value)) else _vector(map(self.unit.from_si, value))
        if isinstance(value, str):
            return value
        return None if isinf(value) else self.unit.from_si(value)

    def is_vector(self, defaults: object) -> bool:
        """Whether the value is one number for each of three axes."""
        return isinstance(self._read(defaults), tuple)

    def _read(self, parameters: object) -> Value:
        return cast(Value, attrgetter(self.field)(parameters))

    def to_si(self, value: Value) -> Value:
        """Convert a value of the file to the unit of the code."""
        if isinstance(value, str):
            return value
        if isinstance(value, tuple):
            return _vector(map(self.unit.to_si, value))
        return self.unit.to_si(value)


class UnitKept(Parameter):
    """A parameter whose value the code has in the unit of the key, as an own method does."""

    @property
    def unit(self) -> Unit:
        """The unit that the key ends with, which nothing converts."""
        return Unit(Parameter.unit.fget(self).symbol)  # type: ignore[attr-defined] # a property


def with_values(
    defaults: T, parameters: Iterable[Parameter], values: Mapping[str, Value | None]
) -> T:
    """Set parameters from the values of a file.

    Args:
        defaults: dataclass with the values of all that is not set.
        parameters: the keys to set; every one of them is in `values`.
        values: by key, in the units of the file; None leaves the default.

    """
    for parameter in parameters:
        value = values[parameter.key]
        if value is not None:
            defaults = _replaced(defaults, parameter.field, parameter.to_si(value))
    return defaults


def _replaced(parameters: T, field: str, value: Value) -> T:
    name, _, within = field.partition(".")
    new = _replaced(getattr(parameters, name), within, value) if within else value
    return cast(T, replace(cast(Any, parameters), **{name: new}))


def _vector(values: Iterable[float]) -> Vec3:
    x, y, z = values
    return (x, y, z)
