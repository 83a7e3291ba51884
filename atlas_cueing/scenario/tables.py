"""A table of a file: what its keys may hold.

Each mistake gets one message that says what is allowed.
"""

from collections.abc import Callable
from math import isfinite
from typing import Annotated, Any, TypeAlias, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

_LARGEST_SHOWN = 1e15
_MOST_WHEELS = 24


class ScenarioTable(BaseModel):
    """A TOML table: no unknown keys, no conversions except integer to float, immutable."""

    model_config = ConfigDict(
        extra="forbid", strict=True, frozen=True, allow_inf_nan=False, defer_build=True
    )

    @classmethod
    def kinds(cls) -> "list[type[ScenarioTable]]":
        """List the tables that a key may hold whose type is this one."""
        return [cls]


def refuse(allowed: str) -> PydanticCustomError:
    """Make the error to raise from a validator; its text says what is allowed."""
    return PydanticCustomError("allowed", "{allowed}", {"allowed": allowed})


def object_to(reason: str) -> PydanticCustomError:
    """Make the error of a validator whose text says what is wrong and what is allowed."""
    return PydanticCustomError("refused", "{reason}", {"reason": reason})


def says(meaning: str) -> Any:
    """Give a key its line of meaning, beside its declaration, in its Annotated type."""
    return Field(description=meaning)


def number(lower: float, upper: float, *, above: bool = False) -> BeforeValidator:
    """Validate a finite number, lower <= value <= upper; with `above`, not `lower` itself."""
    text = f"a number, {lower:g} {'<' if above else '<='} value <= {upper:g}"

    def check(value: Any) -> float:
        """Return the value; raise a refusal that says what is allowed."""
        # An integer of TOML has no bound, and float() of a huge one overflows: compare first.
        if (
            isinstance(value, bool)
            or not isinstance(value, int | float)
            or not lower <= value <= upper
        ):
            raise refuse(text)
        if above and value == lower:
            raise refuse(text)
        return float(value)

    return BeforeValidator(check)


def whole(lower: int, upper: int) -> BeforeValidator:
    """Validate a whole number, `lower <= value <= upper`."""

    def check(value: Any) -> int:
        """Return the value; raise a refusal that says what is allowed."""
        if isinstance(value, bool) or not isinstance(value, int) or not lower <= value <= upper:
            raise refuse(f"a whole number, {lower} <= value <= {upper}")
        return value

    return BeforeValidator(check)


def _finite(value: Any) -> float:
    if (
        isinstance(value, bool)
        or not isinstance(value, int | float)
        or not isfinite(_to_float(value))
    ):
        raise refuse("a finite number")
    return float(value)


def _to_float(value: float) -> float:
    try:
        return float(value)
    except OverflowError:
        return float("inf")


def _three(value: Any) -> Any:
    if not isinstance(value, list | tuple) or len(value) != 3:
        raise refuse("a list of three")
    return tuple(value)


def _one_or_three(value: Any) -> Any:
    if not isinstance(value, list | tuple):
        return (value, value, value)
    if len(value) != 3:
        raise refuse("a number, or a list of three")
    return tuple(value)


def _one_or_each(value: Any) -> Any:
    if not isinstance(value, list | tuple):
        return (value, value, value)
    if not 3 <= len(value) <= _MOST_WHEELS:
        raise refuse("a number, or a list of three, or of one for each wheel")
    return tuple(value)


def _wheels(value: Any) -> Any:
    if not isinstance(value, list | tuple) or not 3 <= len(value) <= _MOST_WHEELS:
        raise refuse(f"a list of three, or of up to {_MOST_WHEELS} (three in a run)")
    return tuple(value)


def check_text(value: Any, allowed: str) -> None:
    """Refuse what is no string; of a number the message says how to write it as a text."""
    if isinstance(value, str):
        return
    number = (
        isinstance(value, int | float) and not isinstance(value, bool) and _has_few_digits(value)
    )
    quoted = f'; as a text: "{value}", in a shell \'"{value}"\'' if number else ""
    raise refuse(f"{allowed}{quoted}")


def _has_few_digits(number: float) -> bool:
    """Whether a number has few digits; one of thousands cannot be printed."""
    return abs(number) < _LARGEST_SHOWN


def text(allowed: str, accept: Callable[[str], bool]) -> BeforeValidator:
    """Validate a string that `accept` returns True for; `allowed` is the message otherwise."""

    def check(value: Any) -> str:
        """Return the value; raise a refusal that says what is allowed."""
        check_text(value, allowed)
        if not accept(value):
            raise refuse(allowed)
        return str(value)

    return BeforeValidator(check)


THREE = BeforeValidator(_three)
WHEELS = BeforeValidator(_wheels)
ONE_OR_EACH = BeforeValidator(_one_or_each)  # one number stands for all wheels
ONE_OR_THREE = BeforeValidator(_one_or_three)  # one number stands for all three

Finite: TypeAlias = Annotated[float, BeforeValidator(_finite)]


def tables_in(annotation: Any) -> list[type[ScenarioTable]]:
    """List the tables that a key of this type may hold."""
    if isinstance(annotation, type) and issubclass(annotation, ScenarioTable):
        return annotation.kinds()
    return [table for argument in get_args(annotation) for table in tables_in(argument)]
