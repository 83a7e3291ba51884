"""A shared key in a file."""

from pathlib import Path

from ...errors import InputError

LARGEST_KEY = 4096  # bytes of its file; keys have 64 at most


def read_key(file: Path, named: str) -> bytes:
    """Return the key in a file, without the white space around it.

    named: how the user calls the file, for messages. Raises InputError for a file that cannot be
    read, is too large, or holds no key.
    """
    try:
        with file.open("rb") as opened:  # perhaps the pipe of a password manager
            key = opened.read(LARGEST_KEY + 1)
    except OSError as error:
        raise InputError(f"{named}: {error.strerror}") from error
    if len(key) > LARGEST_KEY:
        raise InputError(f"{named}: too large, allowed: size <= {LARGEST_KEY} bytes")
    if not key.strip():
        raise InputError(f"{named}: holds no key")
    return key.strip()
