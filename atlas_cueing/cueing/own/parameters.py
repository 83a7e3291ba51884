"""Parameters of an own method: a dataclass or pydantic model becomes declarations like ours."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, Final, Literal, TypeAlias, get_args, get_origin, get_type_hints

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

from ...errors import InputError
from ..parameter import Choice, Parameter, Range, Switch, UnitKept

Values: TypeAlias = Any  # an object of the method's own class Parameters

_FAR: Final = 1e9  # bound of a number that has none
_TYPES: Final = "float, int, bool, Literal of words, or tuple[float, float, float]"


def declared_parameters(model: Any, reserved: Collection[str]) -> tuple[Parameter, ...]:
    """Declare the fields of a dataclass or pydantic model as keys of a file.

    Bounds are those of `pydantic.Field` (ge, gt, le, lt), in Annotated or as the default.

    Raises InputError for a class that is neither, a field of another type or without a default,
    and a reserved name.
    """
    found = list(_fields(model))
    defaults = validated(model, {})
    return tuple(_declared(*field, defaults, reserved) for field in found)


def validated(model: Any, values: Mapping[str, Any]) -> Values:
    """Make an object of the model from values by name. Raises InputError for what it refuses."""
    try:
        return TypeAdapter(model).validate_python(dict(values))
    except ValidationError as error:
        raise InputError(*(_line(detail) for detail in error.errors(include_url=False))) from None
    except (Exception, SystemExit) as error:
        raise InputError(f"Parameters: {type(error).__name__}: {error}") from error


def _line(detail: Any) -> str:
    key = ".".join(map(str, detail["loc"])) or "Parameters"
    return f"{key}: {detail['msg']}"


def _fields(model: Any) -> Iterator[tuple[str, FieldInfo]]:
    if isinstance(model, type) and issubclass(model, BaseModel):
        yield from model.model_fields.items()
    elif isinstance(model, type) and is_dataclass(model):
        hints = get_type_hints(model, include_extras=True)
        for field in fields(model):
            yield field.name, FieldInfo.from_annotated_attribute(hints[field.name], field.default)
    else:
        raise InputError("Parameters: allowed: a dataclass or a pydantic model")


def _declared(key: str, field: FieldInfo, defaults: Values, reserved: Collection[str]) -> Parameter:
    if key in reserved:
        raise InputError(f"Parameters.{key}: is a key of every method; choose another name")
    allowed = _allowed(field, getattr(defaults, key))
    if allowed is None:
        raise InputError(f"Parameters.{key}: is {field.annotation}, allowed: {_TYPES}")
    return UnitKept(key, f"values.{key}", allowed, field.description or "", "by its author")


def _allowed(field: FieldInfo, default: Any) -> Range | Choice | Switch | None:
    kind = field.annotation
    if kind is bool:
        return Switch()
    if get_origin(kind) is Literal and all(isinstance(word, str) for word in get_args(kind)):
        return Choice(get_args(kind))
    three = get_args(kind) == (float, float, float) and len(default) == 3
    return _range(field) if kind in (int, float) or three else None


def _range(field: FieldInfo) -> Range:
    """Give the bounds of a number, by the constraints of its field."""
    bounds = {name: _bound(field, name) for name in ("ge", "gt", "le", "lt")}
    lower = [bounds[name] for name in ("ge", "gt") if bounds[name] is not None]
    upper = [bounds[name] for name in ("le", "lt") if bounds[name] is not None]
    above = bounds["gt"] is not None
    return Range(lower[0] if lower else -_FAR, upper[0] if upper else _FAR, above=above)


def _bound(field: FieldInfo, name: str) -> Any:
    return next((getattr(m, name) for m in field.metadata if hasattr(m, name)), None)
