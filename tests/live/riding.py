"""A live run without a pipeline: ticks with a timing, at a rate, into a ring."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import count
from mmap import mmap
from os import WNOHANG, _exit, fork, waitpid
from pathlib import Path
from time import monotonic, sleep

from recording.flights import ATTACHMENTS, HEAD, METADATA, tumbling_at
from waiting import until

from atlas_cueing.recording import McapRecorder
from atlas_cueing.signals import Tick, Timing
from atlas_cueing.telemetry import LiveWriter

STARTED_NS = 1_700_000_000_123_456_789


def live_recorder(path: Path, *, attitude: bool = False) -> McapRecorder:
    return McapRecorder(
        path,
        head_S=HEAD,
        metadata=METADATA,
        attachments=ATTACHMENTS,
        started_ns=STARTED_NS,
        attitude=attitude,
    )


def live_tick(time: float) -> tuple[Tick, Timing]:
    """Elapsed time is a little more than time, as after a hiccup."""
    return tumbling_at(time), Timing(time, time + 0.25, 1e-5, 2e-4, 0.004, 3.0, 2.0)


def write_ticks(
    writer: LiveWriter,
    rate: float,
    ticks: int | None = None,
    written: Callable[[float], None] = lambda _: None,
) -> None:
    """Write ticks in real time on an absolute schedule, for ever without a number.

    `written` hears of each that is written.
    """
    start = monotonic()
    for k in count():
        if k == ticks:
            return
        sleep(max(start + k / rate - monotonic(), 0.0))
        writer.tick(*live_tick(k / rate))
        written(k / rate)


class SharedClock:
    """Time of a loop and of the process that follows it: it stands still while either of them does.

    So a busy machine changes nothing in what happens when, though both processes are real and run
    side by side.
    """

    def __init__(self) -> None:
        self._times = memoryview(mmap(-1, 16)).cast("d")  # now, and when the follower wakes

    def now(self) -> float:
        """Time that both have come to, s."""
        return self._times[0]

    def sleep(self, seconds: float) -> None:
        """The follower's: wait until the loop has come so far."""
        self._times[1] = self.now() + seconds
        until(lambda: self.now() >= self._times[1])

    def advance(self, seconds: float) -> None:
        """The loop's: go on, but not past a follower that is awake."""
        until(lambda: self._times[1] > self.now())
        self._times[0] += seconds


@contextmanager
def child(function: Callable[[], None]) -> Iterator[int]:
    """The process of a forked function.

    It is reaped, and has to have ended within seconds by then.
    """
    pid = fork()
    if pid == 0:
        try:
            function()
        finally:
            _exit(0)
    try:
        yield pid
    finally:
        until(lambda: waitpid(pid, WNOHANG)[0] == pid)
