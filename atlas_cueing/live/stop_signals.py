"""SIGINT and SIGTERM as a count that the loop looks at.

The first parks, the second stops at once.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


class StopSignals:
    """How often the process has been asked to end."""

    def __init__(self) -> None:
        self.count = 0

    def asked(self) -> int:
        """The count up to now."""
        return self.count

    def ask(self, _number: int = 0, _frame: FrameType | None = None) -> None:
        """As a signal does."""
        self.count += 1


@contextmanager
def ending() -> Iterator[StopSignals]:
    """Signals are counted while inside. For the main thread, where Python delivers them."""
    found = StopSignals()
    before = {number: signal.signal(number, found.ask) for number in _SIGNALS}
    try:
        yield found
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
