"""Ctrl-C, SIGTERM and SIGHUP as a number that is looked at between two ticks.

So the log is always finished.
"""

import signal
import threading
from types import FrameType, TracebackType
from typing import Any, Self

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class StopRequest:
    """Counts the signals that ask this process to end, while it is entered.

    SIGHUP counts only as the first: a terminal that is closed sends two, by its shell and by the
    kernel, and a service manager may send one beside SIGTERM. Where it was ignored at the start, as
    nohup does, it stays ignored.
    Outside the main thread, where Python does not deliver signals, nothing is counted.
    """

    def __init__(self, *, interrupt: bool = True) -> None:
        """Prepare to count.

        interrupt: whether the second signal raises KeyboardInterrupt at once, for what can be
            stopped anywhere; otherwise it is counted like the first.
        """
        self.count = 0
        self._interrupt = interrupt
        self._before: dict[signal.Signals, Any] = {}

    @property
    def requested(self) -> bool:
        """Whether the process has been asked to end."""
        return self.count > 0

    def __enter__(self) -> Self:
        if threading.current_thread() is threading.main_thread():
            self._before = {
                number: signal.signal(number, self._handle)
                for number in _SIGNALS
                if number is not signal.SIGHUP or signal.getsignal(number) is not signal.SIG_IGN
            }
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def finish(self) -> None:
        """Ignore these signals until the process ends: its result is known, and stays."""
        for number in self._before:
            signal.signal(number, signal.SIG_IGN)
        self._before = {}

    def _handle(self, number: int, _frame: FrameType | None) -> None:
        if number == signal.SIGHUP and self.count:
            return
        self.count += 1
        if self._interrupt and self.count > 1:
            raise KeyboardInterrupt
