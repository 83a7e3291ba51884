"""Watches the processes that follow a live run: each death is told once."""

# mypyc: runs every tick

from collections.abc import Callable
from typing import NamedTuple


class Loss(NamedTuple):
    """A helper that has died: what is to be told, and whether the ride goes home for it."""

    text: str
    parks: bool


class HelperWatch:
    """Looks at one helper with each call, so that the cost of a tick does not grow with them."""

    def __init__(self) -> None:
        self._watched: list[tuple[Callable[[], bool], Loss]] = []
        self._next = 0

    def add(self, alive: Callable[[], bool], text: str, *, parks: bool = False) -> None:
        """Watch a helper.

        Args:
            alive: returns whether it runs; takes a microsecond or so.
            text: to be told when it does not.
            parks: whether the ride goes home then.
        """
        self._watched.append((alive, Loss(text, parks)))

    def losses(self) -> tuple[Loss, ...]:
        """Return the helper that was found dead now, if any."""
        if not self._watched:
            return ()
        self._next = (self._next + 1) % len(self._watched)
        alive, loss = self._watched[self._next]
        if alive():
            return ()
        del self._watched[self._next]
        return (loss,)
