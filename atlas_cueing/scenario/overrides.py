"""`--set KEY=VALUE`: keys of a scenario or platform set from the command line."""

from collections.abc import Iterable, Sequence
from copy import copy
from typing import Any, TypeAlias

from ..errors import Mistake, ScenarioError
from ..printable import printable, utf8
from .mistakes import SET, Key, dotted, shown
from .reading import parse_toml

Overrides: TypeAlias = dict[Key, Any]

# Setting one of these takes the other one out: a scenario has exactly one of them.
_ALTERNATIVES: dict[Key, tuple[Key, ...]] = {
    ("platform", "preset"): (("platform", "file"),),
    ("platform", "file"): (("platform", "preset"),),
    ("vehicle", "script"): (("vehicle", "aircraft"), ("vehicle", "initial"), ("vehicle", "input")),
    ("vehicle", "aircraft"): (("vehicle", "script"),),
}


def parse_overrides(texts: Sequence[str]) -> Overrides:
    """Keys and values of `KEY=VALUE` texts, the last of equal keys counts.

    A value that is not TOML is a bare string.

    Raises ScenarioError for every text without a key or `=`.
    """
    overrides: Overrides = {}
    mistakes = []
    for text in texts:
        key, equals, value = text.partition("=")
        parts = tuple(
            int(part) if part.isdecimal() and part.isascii() else part
            for part in key.strip().split(".")
        )
        if not equals or "" in parts or utf8(key) != key:
            mistakes.append(
                Mistake(
                    SET,
                    printable(text),
                    "",
                    "allowed: KEY=VALUE, with a dotted key such as cueing.method=blend",
                )
            )
        else:
            overrides.pop(parts, None)
            overrides[parts] = _value(value.strip())
    if mistakes:
        raise ScenarioError(mistakes)
    return overrides


def _value(text: str) -> Any:
    try:
        table = parse_toml(f"value = {text}", SET)
    except ScenarioError:
        return text
    # a line break in the text could smuggle in more keys
    return table["value"] if table.keys() == {"value"} else text


def apply_overrides(data: dict[str, Any], overrides: Overrides) -> list[Mistake]:
    """Put the values into `data`, making tables where there are none.

    Mistakes for keys that lead nowhere.
    """
    mistakes = []
    for key, value in overrides.items():
        for other in _ALTERNATIVES.get(key, ()):
            if other not in overrides:
                _remove(data, other)
        reason = _put(data, key, value)
        if reason:
            mistakes.append(Mistake(SET, dotted(key), shown(value), reason))
    return mistakes


def with_own(data: dict[str, Any], keys: Iterable[Key]) -> dict[str, Any]:
    """Copy a table as far as `apply_overrides` sets values at these keys; `data` stays as it is.

    What lies beside the keys is shared: a sweep has one file and thousands of runs.
    """
    own = {name: dict(inner) if isinstance(inner, dict) else inner for name, inner in data.items()}
    for key in keys:
        here: Any = own
        for part in key[:-1]:
            place = part if isinstance(here, list) else str(part)
            inner = _inside(here, place)
            if not isinstance(inner, dict | list):
                break
            here[place] = copy(inner)
            here = here[place]
    return own


def _inside(container: Any, place: Any) -> Any:
    try:
        return container[place]
    except (KeyError, IndexError, TypeError):  # said by `apply_overrides`
        return None


def _put(data: Any, key: Key, value: Any) -> str:
    """Set one value; why not, when it cannot be."""
    for i, part in enumerate(key):
        here = dotted(key[:i])
        if isinstance(data, list):
            if not isinstance(part, int) or part >= len(data):
                return f"allowed: {here}.N with 0 <= N <= {len(data) - 1}"
        elif not isinstance(data, dict):
            return f"{here} is not a table"
        else:
            part = str(part)
        if i == len(key) - 1:
            data[part] = value
        else:
            data = data.setdefault(part, {}) if isinstance(data, dict) else data[part]
    return ""


def _remove(data: dict[str, Any], key: Key) -> None:
    table, name = key
    if isinstance(inner := data.get(str(table)), dict):
        inner.pop(name, None)
