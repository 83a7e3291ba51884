"""Every key of the files, as their declarations have it: default, unit, what is allowed.

What is allowed is asked of the declaration itself: the key is given something that no file can
hold, and the answer is the message that a user would get.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from pydantic import ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from ..cueing import METHODS
from ..cueing.parameter import UNITS, Parameter
from ..cueing.stage.stage_parameters import FORCE_GAIN, STAGE
from ..errors import InputError
from .cueing_table import TABLES
from .method_table import MethodTable
from .mistakes import allowed
from .platform_file import Platform
from .scenario import ScenarioFile
from .tables import ScenarioTable, tables_in
from .vehicle_table import SOURCES

_NOTHING = object()  # no value of a file
_LONGEST = 200  # characters of what is allowed; names of aircraft are listed by the command `list`
_OTHER_UNITS = {  # of platforms, beside those of `parameter.UNITS`; the longer ends first
    "_rad_sqrt_s": "rad/sqrt(s)",
    "stiffness_n_m": "N/m",
    "_1_m": "1/m",
    "_1_s": "1/s",
    "_s_m": "s/m",
    "_per_m": "1/m",
    "_kg_m2": "kg m^2",
    "_n_m_s": "N m s",
    "_rad_s3": "rad/s^3",
    "_rad_s2": "rad/s^2",
    "_m_s3": "m/s^3",
    "_n_m": "N m",
    "_kg": "kg",
    "_n": "N",
}
_SWEEP = (
    ("sweep.KEY", "a list of values, or a table of a random draw", "every run has one of these"),
)


@dataclass(frozen=True, slots=True)
class KeyEntry:
    """A key: its dotted name as `--set` takes it, and what its declaration says of it.

    of: the method or the source that has it; empty where all have it. unit: by the end of the name.
    """

    key: str
    of: str
    unit: str
    default: Any
    allowed: str
    meaning: str

    @property
    def written(self) -> str:
        """The default as a file has it."""
        return _written(self.default)

    def line(self) -> str:
        """Everything in one line."""
        default = "" if self.default is None else f" = {self.written}"
        unit = f" [{self.unit}]" if self.unit else ""
        of = f" ({self.of})" if self.of else ""
        return f"{self.key}{default}{unit}{of}: {self.allowed}; {self.meaning}"


def keys(prefix: str = "", method: str = "") -> list[KeyEntry]:
    """List the keys that begin with `prefix`, in the order of a file; of one method if it is named.

    Raises InputError for a method that is none.
    """
    if method and method not in TABLES:
        raise InputError(f"--method {method}: allowed: {', '.join(TABLES)}")
    found = [
        *_of_table(ScenarioFile, skip=("vehicle", "cueing", "sweep")),
        *(e for n, t in SOURCES.items() for e in _of_table(t, "vehicle.", f"source {n}")),
        *(e for n, t in TABLES.items() for e in _of_method(t, f"method {n}")),
        *_of_table(Platform, "platform."),
        *(KeyEntry(key, "", "", None, may, meaning) for key, may, meaning in _SWEEP),
    ]
    of = f"method {method}"
    wanted = (entry for entry in found if not method or entry.of == of)
    return _merged(entry for entry in wanted if entry.key.startswith(prefix))


def _merged(entries: Iterable[KeyEntry]) -> list[KeyEntry]:
    """Make one entry of those that differ only in whose they are."""
    owners: dict[KeyEntry, list[str]] = {}
    for entry in entries:
        owners.setdefault(replace(entry, of=""), []).append(entry.of)
    return [replace(entry, of=_joined(of)) for entry, of in owners.items()]


def _joined(of: Sequence[str]) -> str:
    kinds = {word.partition(" ")[0] for word in of if word}
    names = ", ".join(dict.fromkeys(word.partition(" ")[2] for word in of if word))
    return f"{kinds.pop()} {names}" if kinds else ""


def _of_method(table: type[MethodTable], of: str) -> Iterator[KeyEntry]:
    method = table.declaration
    told = {f"cueing.{p.key}": p for p in (FORCE_GAIN, *method.parameters)}
    told |= {f"cueing.stage.{p.key}": p for p in STAGE}
    for entry in _of_table(table, "cueing.", of):
        if entry.key == "cueing.method":
            meaning, may = METHODS[method.name].summary, f"allowed: {method.name!r}"
            yield KeyEntry(entry.key, of, "", method.name, may, meaning)
            continue
        parameter = told.get(entry.key)
        yield _with_words(entry, parameter) if parameter else entry


def _with_words(entry: KeyEntry, parameter: Parameter) -> KeyEntry:
    meaning = f"{parameter.description} (default: {parameter.source})"
    return KeyEntry(entry.key, entry.of, entry.unit, entry.default, entry.allowed, meaning)


def _of_table(
    table: type[ScenarioTable], before: str = "", of: str = "", skip: tuple[str, ...] = ()
) -> Iterator[KeyEntry]:
    for key, field in table.model_fields.items():
        inner = tables_in(field.annotation)
        if key in skip:
            continue
        if inner:
            for each in inner:
                number = "N." if "tuple[" in str(field.annotation) else ""  # [[key]]: many tables
                yield from _of_table(each, f"{before}{key}.{number}", of)
        else:
            may = _allowed(table, key)
            meaning = field.description or _first_line(table)
            yield KeyEntry(f"{before}{key}", of, _unit(key), _default(field), may, meaning)


def _allowed(table: type[ScenarioTable], key: str) -> str:
    """What the key's own refusal says."""
    try:
        table.model_validate({key: _NOTHING}, context={"folder": None})
    except ValidationError as error:
        for detail in error.errors(include_url=False):
            if detail["loc"][:1] == (key,):
                return _short(allowed(detail, table).removeprefix("allowed: "))
    except Exception as error:  # noqa: BLE001 - a validator that meets no such value in files
        return f"{type(error).__name__}"
    return "any"


def _short(text: str) -> str:
    head, names, _ = text.partition("; allowed: ")
    return head if names and len(text) > _LONGEST else text


def _default(field: FieldInfo) -> Any:
    value = field.get_default(call_default_factory=False)
    return None if value is PydanticUndefined or value == () or value == "" else value


def _unit(key: str) -> str:
    ends = _OTHER_UNITS | {end: unit.symbol for end, unit in UNITS.items()}
    return next((symbol for end, symbol in ends.items() if key.endswith(end)), "")


def _first_line(table: type[ScenarioTable]) -> str:
    return (table.__doc__ or "").strip().splitlines()[0].rstrip(".") if table.__doc__ else ""


def _written(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return f"[{', '.join(map(_written, value))}]"
    return repr(value) if isinstance(value, str) else f"{value}"
