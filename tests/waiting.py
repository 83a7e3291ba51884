"""Waiting for other processes and threads."""

from collections.abc import Callable
from itertools import count
from time import sleep

LOOK_S = 0.005  # s between two looks


def until(what: Callable[[], object], seconds: float = 30.0) -> None:
    """Wait for something that has to happen, and soon.

    What counts is how often was looked: while the machine stands still, for whatever reason, nobody
        gets older.
    """
    for look in count():
        if what():
            return
        assert look * LOOK_S < seconds, f"still waiting after {look} looks"
        sleep(LOOK_S)
