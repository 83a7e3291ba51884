"""TOML from strangers: size, nesting and dotted keys are bounded before the parser sees the text.

tomllib takes seconds for one dotted key of 40 kB and raises RecursionError for deep arrays.
"""

import re
import stat
import tomllib
from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Iterator
from os.path import isfile
from pathlib import Path
from typing import Any

from ..errors import Mistake, ScenarioError

LARGEST_FILE = 256 * 1024  # bytes; a scenario of a thousand timed inputs has 80 kB
DEEPEST_NESTING = 16  # brackets within brackets; the files here need three
LONGEST_DOTTED_KEY = 16  # dots; the files here need three
LONGEST_KEY = 100  # characters; the longest here has 25
# of all tables; thousands of timed inputs, and every one may be a mistake to be told
MOST_KEYS = 20_000
_LOG = b"\x89MCAP"  # how logs begin

# Strings and comments hold brackets and dots that mean nothing. A string may lack its end, so that
# every character is read once (the parser stops there anyway), and nothing is given back (`*+`); up
# to five quotes end a string of three.
_QUOTED = re.compile(
    r"""
      \"{3} (?: \\. | (?!\"{3}) [^\\] )*+ (?:\"{3,5})?
    | '{3}  (?: (?!'{3}) . )*+ (?:'{3,5})?
    | \"    (?: \\. | [^\"\\\n] )*+ \"?
    | '     [^'\n]*+ '?
    | \#    [^\n]*+
    """,
    re.DOTALL | re.VERBOSE,
)
_BETWEEN_KEYS = re.compile(r"[=,{}\[\]\n]")


def read_toml(path: Path) -> dict[str, Any]:
    """The file as a table.

    Raises ScenarioError when it cannot be read, is too large or nested, or is not TOML.
    """
    return parse_toml(_read(path), str(path))


class TomlFiles:
    """Files as they were when first asked for, each read once.

    Many scenarios may have them in common.
    """

    def __init__(self) -> None:
        self._found: dict[Path, dict[str, Any] | ScenarioError] = {}

    def read(self, path: Path) -> dict[str, Any]:
        """Read as `read_toml` does; the table is the same each time, not to be changed."""
        if path not in self._found:
            try:
                self._found[path] = read_toml(path)
            except ScenarioError as error:
                self._found[path] = error
        found = self._found[path]
        if isinstance(found, ScenarioError):
            raise found
        return found


def parse_toml(text: str, file: str) -> dict[str, Any]:
    """Parse a text as `read_toml` does; `file` is for messages."""
    _check_shape(text, file)
    try:
        table = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        # not only TOMLDecodeError: an integer of 5000 digits is a plain ValueError
        raise _mistake(file, "TOML", f"not valid: {error}") from None
    _check_keys(table, file)
    return table


def _read(path: Path) -> str:
    try:
        if not stat.S_ISREG(path.stat().st_mode):  # opening a pipe would wait for ever
            raise _mistake(str(path), "file", "not a regular file")
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except (OSError, ValueError) as error:  # ValueError: a NUL in the path
        reason = error.strerror if isinstance(error, OSError) else str(error)
        hint = _meant(path) if isinstance(error, FileNotFoundError) else ""
        raise _mistake(str(path), "file", f"cannot be read: {reason}{hint}") from None
    if content.startswith(_LOG):
        raise _mistake(
            str(path),
            "file",
            "is a log (MCAP), allowed: a TOML file; to look at a log: atlas-cueing review",
        )
    if len(content) > LARGEST_FILE:
        raise _mistake(str(path), "file", f"too large, allowed: size <= {LARGEST_FILE} bytes")
    if content.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        raise _mistake(str(path), "file", "is UTF-16 text, allowed: UTF-8; save it anew as UTF-8")
    try:
        return content.removeprefix(BOM_UTF8).decode()  # Windows' editors put the mark there
    except UnicodeDecodeError as error:
        raise _mistake(str(path), "file", f"not UTF-8 text: byte {error.start}") from None


def _meant(path: Path) -> str:
    """Ask whether a file was meant whose name lacks its ending, or the folder of the examples."""
    places = (path.parent, path.parent / "scenarios")
    names = (path.name, f"{path.name}.toml")
    near = [place / name for place in places for name in names if isfile(place / name)]
    return f"; did you mean {near[0]}?" if near else ""


def _check_shape(text: str, file: str) -> None:
    if len(text) > LARGEST_FILE:
        raise _mistake(file, "file", f"too large, allowed: size <= {LARGEST_FILE} bytes")
    bare = _QUOTED.sub("_", text)
    if max(piece.count(".") for piece in _BETWEEN_KEYS.split(bare)) > LONGEST_DOTTED_KEY:
        raise _mistake(
            file, "TOML", f"a key has too many dots, allowed: dots <= {LONGEST_DOTTED_KEY}"
        )
    depth = 0
    for bracket in re.findall(r"[\[\]{}]", bare):
        depth += 1 if bracket in "[{" else -1
        if depth > DEEPEST_NESTING:
            raise _mistake(
                file, "TOML", f"nested too deeply, allowed: brackets <= {DEEPEST_NESTING}"
            )


def count_keys(table: dict[str, Any]) -> int:
    """Keys of a table and of all tables in it."""
    return sum(map(len, _tables_of(table)))


def _check_keys(table: dict[str, Any], file: str) -> None:
    """Messages name keys, and each mistake is a message."""
    for key in (key for inner in _tables_of(table) for key in inner if len(key) > LONGEST_KEY):
        raise _mistake(
            file,
            f"{key[:LONGEST_KEY]!r}...",
            f"a key is too long, allowed: length <= {LONGEST_KEY}",
        )
    keys = count_keys(table)
    if keys > MOST_KEYS:
        raise _mistake(file, "file", f"{keys} keys, allowed: keys <= {MOST_KEYS}")


def _tables_of(table: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The table and all in it, without recursion."""
    inside: list[Any] = [table]
    while inside:
        here = inside.pop()
        if isinstance(here, dict):
            yield here
        values = here.values() if isinstance(here, dict) else here
        inside += [inner for inner in values if isinstance(inner, dict | list)]


def _mistake(file: str, key: str, allowed: str) -> ScenarioError:
    return ScenarioError([Mistake(file, key, "", allowed)])
