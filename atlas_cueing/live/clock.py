"""The clock of the loop."""

import ctypes
import ctypes.util
import time
from typing import Protocol

_TIMER_ABSTIME = 1  # time.h


class Clock(Protocol):
    """Monotonic time that can be waited for."""

    def now(self) -> float:
        """Return the time in s from some start; it never goes back."""

    def sleep_until(self, time: float) -> None:
        """Return at `time` (s) or as soon after it as possible; at once when it has passed."""


class _Timespec(ctypes.Structure):
    _fields_ = (("seconds", ctypes.c_long), ("nanoseconds", ctypes.c_long))


class MonotonicClock:
    """CLOCK_MONOTONIC, waited for in absolute time.

    So a delay before the call is not added to the wait.
    """

    def __init__(self) -> None:
        library = ctypes.CDLL(ctypes.util.find_library("c"), use_errno=True)
        self._nanosleep = getattr(library, "clock_nanosleep", None)
        self._until = _Timespec()
        self._pointer = ctypes.byref(self._until)

    def now(self) -> float:
        """Return the seconds since the machine started, as time.monotonic."""
        return time.monotonic()

    def sleep_until(self, time_: float) -> None:
        """Sleep in the kernel until `time_` (s); signals are handled and do not end the wait."""
        seconds = int(time_)
        self._until.seconds, self._until.nanoseconds = seconds, int((time_ - seconds) * 1e9)
        while self.now() < time_:
            if self._nanosleep is None:
                time.sleep(max(0.0, time_ - self.now()))
            else:
                self._nanosleep(time.CLOCK_MONOTONIC, _TIMER_ABSTIME, self._pointer, None)
