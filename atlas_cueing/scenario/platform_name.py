"""The name of a platform or a scenario: what files may be called by."""

from typing import Any
from unicodedata import category, normalize

from pydantic import BeforeValidator

from .tables import check_text, refuse

_LONGEST_NAME = 100  # characters, and ...
_LONGEST_NAME_BYTES = 200  # ... bytes in UTF-8: names of files, which it begins, end at 255
_LETTERS = ("L", "M", "Nd")  # categories of Unicode: letters, marks upon them, digits


def _name(value: Any) -> str:
    """A name, composed (NFC), so that what looks the same is the same."""
    allowed = "letters and digits of any alphabet, '.', '_', '-', not beginning with '.' or a mark"
    allowed += f", at most {_LONGEST_NAME} characters and {_LONGEST_NAME_BYTES} bytes"
    check_text(value, allowed)
    name = normalize("NFC", value)
    if not 0 < len(name) <= _LONGEST_NAME or not all(map(_is_name_part, name)):
        raise refuse(allowed)
    if (
        name[0] == "."
        or category(name[0]).startswith("M")
        or len(name.encode()) > _LONGEST_NAME_BYTES
    ):
        raise refuse(allowed)
    return name


def _is_name_part(character: str) -> bool:
    return character in "._-" or category(character).startswith(_LETTERS)


NAME = BeforeValidator(_name)
