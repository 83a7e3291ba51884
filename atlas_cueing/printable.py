"""Texts of others (names, reasons, messages) as they may be shown on a terminal or a page."""

from html import escape

_BYTES = range(0xDC80, 0xDD00)  # what Python makes of the bytes of a file name that are not UTF-8


def printable(text: str) -> str:
    r"""Return `text` on one line; characters that are not visible are written out, as in `\x1b`.

    Written out are control characters, line breaks, spaces other than the plain one, marks that
    turn the direction of writing, characters without a width, and lone surrogates. A byte of a
    file name that is not UTF-8 becomes `\xe9`.
    """
    return text if text.isprintable() else "".join(map(_written_out, text))


def printable_lines(text: str) -> str:
    """Return `text` as `printable` does, but keep its line feeds and tabs."""
    return "\n".join("\t".join(map(printable, line.split("\t"))) for line in text.split("\n"))


def html_text(text: str) -> str:
    """Return `text` as a part of an HTML page, on one line and written out as by `printable`."""
    return escape(printable(text))


def is_name(text: str) -> bool:
    """Whether `text` may name a file: visible characters, and bytes that are not UTF-8."""
    visible = "".join(character for character in text if ord(character) not in _BYTES)
    return text != "" and visible.isprintable()


def utf8(text: str) -> str:
    """Return `text` with a question mark for every character that UTF-8 has no bytes for."""
    return text.encode(errors="replace").decode()


def _written_out(character: str) -> str:
    if character.isprintable():
        return character
    if ord(character) in _BYTES:
        return f"\\x{ord(character) - 0xDC00:02x}"
    return character.encode("unicode_escape").decode()
