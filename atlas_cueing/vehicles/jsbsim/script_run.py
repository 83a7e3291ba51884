"""The times that a JSBSim script states, read without loading it."""

import re
from pathlib import Path
from typing import TypeAlias

_LARGEST_SCRIPT = 20_000_000  # bytes; what JSBSim is given at most
_NUMBER = rb"""\s*=\s*["']\s*([0-9.eE+-]+)\s*["']"""

Times: TypeAlias = tuple[float | None, float | None, float | None]


def script_run(script: Path) -> Times:
    """Return start, end and step of a script, s, each None where it does not state one.

    It is looked through as bytes, not parsed: planning a batch looks at thousands. One that cannot
    be read states nothing; that is reported when its content is asked for.
    """
    try:
        with script.open("rb") as file:
            run = re.search(rb"<run\b([^>]*)>", file.read(_LARGEST_SCRIPT))
    except OSError:
        run = None
    text = run[1] if run else b""
    return _number(b"start", text), _number(b"end", text), _number(b"dt", text)


def _number(name: bytes, text: bytes) -> float | None:
    found = re.search(rb"\b" + name + _NUMBER, text)
    try:
        return float(found[1]) if found else None
    except ValueError:
        return None
