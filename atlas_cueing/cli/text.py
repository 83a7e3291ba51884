"""Numbers as text, for people and for programs."""

import json
import re
from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any

import typer

from ..printable import printable

FIGURES = """
What the figures say of a ride, beside the limits that it keeps:

  mismatch: how far it is from the flight, as far as a head feels it; 1 is just noticed, all the way

  mismatch direction, rate: what turning the cabin can change; mismatch magnitude: what it cannot

  mismatch worst 10 s: the part that riders remember

  mismatch ratio: beside a cabin that does not turn, which has 1 (in compare and batch, with a ride by `still`)

  perceived tilt, turn: a second opinion, by a model of perception
"""  # noqa: E501 - a paragraph a line
"""End of the help of commands that show figures; `evaluation.metric_table` has the definitions."""

_COMMAND = re.compile(r"^  (?:atlas-cueing|dask) .*$", re.MULTILINE)
_WIDTH = 76  # characters of a command in a help text, which is 80 wide

TRUST_MODELS = (  # help of --trust-models
    "Fly a script, an aircraft or a cueing method that lies beside the scenario; it is a program"
    " of whoever wrote it."
)


def one_json(figures: Mapping[str, Any]) -> str:
    """One JSON object; a number that is not finite is null, as JSON has no other word for it."""
    return json.dumps(_plain(figures), allow_nan=False, indent=2)


def copyable(epilog: str) -> str:
    """The end of a help text, with long commands broken by a backslash, as a shell takes them.

    A command is a line of its own that begins with two blanks and the name of a program.
    """
    return _COMMAND.sub(lambda found: "\b\n" + _broken(found[0]), epilog)


def _broken(command: str) -> str:
    """The command in lines of at most _WIDTH characters, broken before options."""
    first, *options = re.split(" +(?=-)", command)
    lines = [first]
    for option in options:
        if len(lines[-1]) + len(option) + len("  \\") > _WIDTH:
            lines.append("     ")
        lines[-1] += f" {option}"
    return " \\\n".join(lines)


def aligned(rows: Sequence[tuple[str, str]], indent: str = "  ") -> list[str]:
    """Lines of name and value, the values under each other and each on one line."""
    width = max((len(name) for name, _ in rows), default=0)
    return [f"{indent}{name:<{width}}  {printable(value)}".rstrip() for name, value in rows]


def say(line: str) -> None:
    """Print one line on stderr.

    A line break in it, which can only be part of a name, is written out.
    """
    typer.echo(printable(line), err=True)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner) for inner in value]
    return None if isinstance(value, float) and not isfinite(value) else value
