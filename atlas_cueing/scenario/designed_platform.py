"""A platform file with some of its numbers replaced, and all its other words kept."""

import re
import tomllib
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from .platform_file import Platform

_TABLE = re.compile(r"\s*\[{1,2}\s*([\w-]+)\s*\]{1,2}\s*(?:#.*)?")
_LINE = re.compile(r"\s*([\w-]+)\s*=")
_REPLACED = {
    "wheel": ("contact", "drive", "radius_m"),
    "drive": ("gear", "torque_n_m", "torque_rms_n_m"),
}
_MARK = "# designed"


def designed_text(source: Path, platform: Platform, remark: str, lines: tuple[str, ...]) -> str:
    """The text of a platform file for `platform`, made from the file that it came from.

    Comments of the source, which mark what is assumed, stay with the numbers that stay; a number
    that differs gets `remark` (without a line break) in their place. lines: what the file begins
    with, without the comment sign. The text reads as `platform` again: a source in which numbers
    are not one a line is written anew, without its comments.
    """
    head = "".join(f"# {line}\n" for line in lines)
    try:
        text = head + _rewritten(source.read_text("utf-8"), platform, remark)
        if Platform.model_validate(tomllib.loads(text)) == platform:
            return text
    except (ValidationError, tomllib.TOMLDecodeError, LookupError):
        pass  # not written one number a line
    import tomli_w

    plain = tomli_w.dumps(platform.model_dump(mode="json", exclude_none=True))
    note = (
        f"# {remark}: wheels, drive, preload. All else is as in {source.name}, whose comments say"
    )
    return f"{head}{note}\n# which numbers are assumed.\n{plain}"


def _rewritten(text: str, platform: Platform, remark: str) -> str:
    table, wheel, out = "", -1, list[str]()
    for line in text.splitlines():
        found = _TABLE.fullmatch(line)
        if found:
            table = found[1]
            wheel += table == "wheel"
            if table == "wheel" and wheel == 0:
                _leave_comment(out)
            out.append(line)
        else:
            out.append(_line(line, table, wheel, platform, remark))
    added = len(platform.preload or ()) - sum(1 for line in out if _is_table(line, "preload"))
    for each in (
        (platform.preload or ())[len(platform.preload or ()) - added :] if added > 0 else ()
    ):
        out += ["", "[[preload]]", f"contact = {list(each.contact)} {_MARK}: straight down"]
        out.append(f"force_n = {each.force_n!r} # {remark}")
    return "\n".join(out) + "\n"


def _leave_comment(out: list[str]) -> None:
    """Take out what the comment above the first wheel says of the old layout."""
    while out and out[-1].startswith("#"):
        out.pop()


def _is_table(line: str, name: str) -> bool:
    found = _TABLE.fullmatch(line)
    return bool(found and found[1] == name)


def _line(line: str, table: str, wheel: int, platform: Platform, remark: str) -> str:
    found = _LINE.match(line)
    key = found[1] if found else ""
    if table == "" and key == "name":
        return f'name = "{platform.name}"'
    if key not in _REPLACED.get(table, ()):
        return line
    value = getattr(platform.wheel[wheel] if table == "wheel" else platform.drive, key)
    return line if _holds(line, key, value) else f"{key} = {_toml(value)} # {remark}"


def _holds(line: str, key: str, value: Any) -> bool:
    """Whether the line has this value already."""
    old = tomllib.loads(line)[key]
    return bool((tuple(old) if isinstance(old, list) else old) == value)


def _toml(value: Any) -> str:
    return repr(list(value) if isinstance(value, tuple) else value)
