"""Logs that are input: one that is damaged is bad input, with what may help."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import InputError, LogError


@contextmanager
def input_log(log: Path) -> Iterator[None]:
    """Turn LogError of what is read from `log` into InputError: nothing was written."""
    try:
        yield
    except LogError as error:
        from ..review import advice

        todo = advice(log)
        raise InputError(f"{error}; {todo}" if todo else str(error)) from error
