"""Files that are there whole or not at all."""

from pathlib import Path


def write_whole(file: str | Path, text: str) -> None:
    """Write `text` as UTF-8 into `file` under a passing name beside it; what was there stays until the new one is whole.

    What UTF-8 has no bytes for, as in a name that is no text, becomes a question mark. Raises OSError, and leaves nothing new.
    """
    file = Path(file)
    part = file.with_name(f"{file.name}.writing")
    try:
        part.write_text(text, encoding="utf-8", errors="replace")
        part.replace(file)
    finally:
        part.unlink(missing_ok=True)
