"""Real-time scheduling of this process.

No garbage collection, and, where the system permits it, priority, locked memory and a core.
"""

import ctypes
import gc
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field

# of 1 to 99; below the kernel's threads for interrupts (50 on most systems) it would wait for them
FIFO_PRIORITY = 80
_MCL_CURRENT, _MCL_FUTURE = 1, 2  # sys/mman.h
_PR_SET_TIMERSLACK, _PR_GET_TIMERSLACK = 29, 30  # sys/prctl.h
_LEAST_SLACK = 1  # ns


@dataclass(slots=True)
class RealtimeScheduling:
    """What the system granted, and what it refused and why."""

    granted: list[str] = field(default_factory=list)
    refused: list[str] = field(default_factory=list)


@contextmanager
def realtime_scheduling(priority: bool) -> Iterator[RealtimeScheduling]:
    """Collect garbage, freeze what is left, and switch collection off while inside.

    Sleeps of this thread end on time, where a system would else let them last up to 50 us longer
    to wake up less often (prctl(2), timer slack).

    With `priority` the system is asked for priority, locked memory and a core as well; what it
    refuses is noted and does no harm.

    Priority, memory, affinity, sleeps and collection are as before afterwards; only
    SCHED_RESET_ON_FORK stays where the system does not allow to take it back (sched(7)).
    """
    found = RealtimeScheduling()
    scheduler, affinity = os.sched_getscheduler(0), os.sched_getaffinity(0)
    parameters = os.sched_getparam(0)
    collecting, slack = gc.isenabled(), _slack(_PR_GET_TIMERSLACK)
    _slack(_PR_SET_TIMERSLACK, _LEAST_SLACK)
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        if priority:
            _ask(found, "SCHED_FIFO", _take_priority)
            _ask(found, "mlockall", _lock_memory)
            _ask(found, "affinity", _take_core)
        yield found
    finally:
        if "SCHED_FIFO" in found.granted:
            _restore_scheduler(scheduler, parameters)
        if "mlockall" in found.granted:
            ctypes.CDLL(None).munlockall()
        if "affinity" in found.granted:
            with suppress(OSError):  # all its cores may have gone meanwhile
                os.sched_setaffinity(0, affinity)
        if slack > 0:
            _slack(_PR_SET_TIMERSLACK, slack)
        gc.unfreeze()
        if collecting:
            gc.enable()


def collections() -> int:
    """Return the number of garbage collections of this process up to now."""
    return sum(generation["collections"] for generation in gc.get_stats())


def _ask(found: RealtimeScheduling, name: str, request: Callable[[], None]) -> None:
    try:
        request()
    except OSError as error:
        found.refused.append(f"{name}: {error.strerror or error}")
    else:
        found.granted.append(name)


def _slack(option: int, nanoseconds: int = 0) -> int:
    """Return or set the timer slack of this thread, ns; -1 where there is none."""
    prctl = getattr(ctypes.CDLL(None), "prctl", None)
    return int(prctl(option, nanoseconds, 0, 0, 0)) if prctl else -1


def _take_priority() -> None:
    os.sched_setscheduler(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(FIFO_PRIORITY))


def _restore_scheduler(scheduler: int, parameters: os.sched_param) -> None:
    try:
        os.sched_setscheduler(0, scheduler, parameters)
    except OSError:
        with suppress(OSError):
            os.sched_setscheduler(0, scheduler | os.SCHED_RESET_ON_FORK, parameters)


def _lock_memory() -> None:
    if ctypes.CDLL(None, use_errno=True).mlockall(_MCL_CURRENT | _MCL_FUTURE):
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))


def _take_core() -> None:
    """Take the last core: interrupts and new processes tend to the first ones."""
    cores = os.sched_getaffinity(0)
    if len(cores) < 2:
        raise OSError(0, "there is only one core")
    os.sched_setaffinity(0, {max(cores)})
