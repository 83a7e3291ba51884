"""From pydantic's errors to mistakes: file, key as written, value found, what is allowed."""

import re
from collections.abc import Collection, Sequence
from datetime import date, time
from difflib import get_close_matches
from functools import lru_cache
from typing import Any, TypeAlias

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from ..cueing import METHODS
from ..cueing.own.sources import installed_methods
from ..errors import Mistake
from .tables import ScenarioTable, tables_in

# pydantic's names
_KINDS = {"model_type": "a table", "bool_type": "true or false", "string_type": "a string"}

Key: TypeAlias = tuple[str | int, ...]

SET = "--set"  # where a key from the command line came from
MOST_SHOWN = 100  # mistakes of one file; who has more will mend the first ones first
_LONGEST_VALUE = 60  # characters of a found value that a message repeats


def mistakes_of(
    error: ValidationError, table: type[ScenarioTable], data: dict[str, Any], name_file: "FileNamer"
) -> list[Mistake]:
    """List every mistake once, in the order of the file.

    Args:
        error: what pydantic found.
        table: the class that was to be validated.
        data: the file as it was read.
        name_file: gives the file (or option) that a key came from.

    Of very many only MOST_SHOWN are looked at, and a last one says how many are left.
    """
    found: dict[Key, tuple[tuple[int, ...], Mistake]] = {}
    details = error.errors(include_url=False)
    for detail in details[:MOST_SHOWN]:
        key, value = _as_written(detail["loc"], data)
        if detail["type"] == "union_tag_invalid":
            key, value = (*key, "method"), _lookup(value, "method")
        mistake = Mistake(name_file(key), dotted(key), shown(value), allowed(detail, table))
        found.setdefault(key, (_position(key, data), mistake))
    mistakes = [mistake for _, mistake in sorted(found.values(), key=lambda pair: pair[0])]
    return mistakes + more(len(details) - MOST_SHOWN, name_file(()))


def more(count: int, file: str) -> list[Mistake]:
    """List what stands for `count` mistakes that are not shown; nothing for none."""
    return [Mistake(file, "file", "", f"and {count} more mistakes")] if count > 0 else []


class FileNamer:
    """The file that a key came from: `--set` for the command line, else the file itself."""

    def __init__(self, file: str, overridden: Collection[Key] = ()) -> None:
        self._file = file
        self._overridden = overridden

    def __call__(self, key: Key) -> str:
        """Give the name for messages of the file that a key came from."""
        return SET if any(_related(key, path) for path in self._overridden) else self._file


def _related(key: Key, path: Key) -> bool:
    """Whether one key holds the other."""
    return key[: len(path)] == path or path[: len(key)] == key


@lru_cache(maxsize=64)  # the keys of a sweep, again and again
def dotted(key: Key) -> str:
    """Write a key as `--set` takes it, such as `vehicle.input.0.value`.

    A part that would not print in one line is quoted.
    """
    return ".".join(text if (text := str(part)).isprintable() else repr(part) for part in key)


def nearest(word: str, known: Collection[str]) -> str:
    """Say what is allowed instead of an unknown word.

    The nearest one comes first, then all if they are few.
    """
    near = get_close_matches(word, known, n=1, cutoff=0.5)
    guess = f"did you mean {near[0]!r}? " if near else ""
    return (
        f"{guess}allowed: {', '.join(sorted(known))}"
        if len(known) <= 20 or not near
        else guess.rstrip()
    )


def shown(value: Any) -> str:
    """Write a found value as TOML would, cut to a readable length.

    It is empty when there is no value, or it is a table or a list of tables.
    """
    if value is None or isinstance(value, dict) or _holds_tables(value):
        return ""
    if isinstance(value, date | time):  # a datetime is a date
        return value.isoformat()
    text = str(value).lower() if isinstance(value, bool) else _repr(value)
    return text if len(text) <= _LONGEST_VALUE else text[:_LONGEST_VALUE] + "..."


def _holds_tables(value: Any) -> bool:
    return isinstance(value, list | tuple) and any(isinstance(each, dict) for each in value)


def _repr(value: Any) -> str:
    try:
        return repr(value)
    except ValueError:  # an integer of more than 4300 digits
        return "an integer of thousands of digits"


def allowed(detail: ErrorDetails, table: type[ScenarioTable]) -> str:
    """Say what is allowed where pydantic found this error in a table."""
    kind, context = detail["type"], detail.get("ctx", {})
    if kind == "extra_forbidden":
        *where, word = detail["loc"]
        return (
            f"unknown key; {nearest(str(word), _known_keys(table, where))}{_of_others(where, word)}"
        )
    if kind == "missing":
        return "missing"
    if kind == "union_tag_invalid":
        return nearest(str(context["tag"]), _methods(context["expected_tags"]))
    if kind == "literal_error":
        return f"allowed: {context['expected']}"
    if kind in _KINDS:
        return f"allowed: {_KINDS[kind]}"
    if kind == "allowed":
        return f"allowed: {context['allowed']}"
    return detail["msg"]


def _of_others(where: Sequence[str | int], word: str | int) -> str:
    """Say which cueing methods have a key that the chosen one has not."""
    if len(where) != 2 or where[0] != "cueing":
        return ""
    others = [
        method.name
        for method in METHODS.values()
        if any(word == parameter.key for parameter in method.parameters)
    ]
    return f"; it is a key of {', '.join(others)}, and not of {where[1]}" if others else ""


def _methods(tags: str) -> list[str]:
    """List what a method may be: the tags of the package's tables, and in place of the last one.

    That one stands for installed methods and for classes in files.
    """
    *own, _ = re.findall(r"'(\w+)'", tags)
    return [*own, *installed_methods(), "FILE.py:CLASS"]


def _known_keys(table: type[ScenarioTable], loc: Sequence[str | int]) -> list[str]:
    """List the keys of the table at `loc`; a method's tag in `loc` picks one of several tables."""
    tables = [table]
    for part in loc:
        if isinstance(part, int):
            continue
        inner = [
            t
            for candidate in tables
            if part in candidate.model_fields
            for t in tables_in(_type(candidate, part))
        ]
        tables = inner or [
            t
            for t in tables
            if "method" in t.model_fields and t.model_fields["method"].default == part
        ]
    return [name for candidate in tables for name in candidate.model_fields]


def _type(table: type[ScenarioTable], field: str) -> Any:
    return table.model_fields[field].annotation


def _as_written(loc: Sequence[str | int], data: Any) -> tuple[Key, Any]:
    """Give the key as it stands in the file, and its value.

    It is without union tags, and without the places in a number that stands for three.
    """
    key: list[str | int] = []
    value = data
    for i, part in enumerate(loc):
        in_list = isinstance(value, list) and isinstance(part, int) and part < len(value)
        if in_list or (isinstance(value, dict) and part in value):
            key.append(part)
            value = value[part]
        elif isinstance(value, dict) and i == len(loc) - 1:
            return (*key, part), None
    return tuple(key), value


def _position(key: Key, data: Any) -> tuple[int, ...]:
    """Give the key's place in the file, for sorting; a missing one comes after its table's last."""
    places = []
    for part in key:
        if isinstance(data, dict):
            places.append(list(data).index(part) if part in data else len(data))
        else:
            places.append(int(part))
        data = _lookup(data, part)
    return tuple(places)


def _lookup(container: Any, part: str | int) -> Any:
    if isinstance(container, dict):
        return container.get(str(part))
    return (
        container[part]
        if isinstance(container, list) and isinstance(part, int) and part < len(container)
        else None
    )
