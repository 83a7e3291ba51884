"""From the ring of a live run into its log, so that what a kill can lose is bounded."""

import os
import select
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from ...errors import OutputError
from ...printable import printable
from ...recording import McapRecorder
from ...signals import StateChange
from ...telemetry import Ring, RingReader
from ...telemetry.messages import END, STATUS, TICK, numbers, status

# ticks are on their way to the disk after at most this and one poll: the loss by a kill is to be
# below 0.1 s
FLUSH_S = 0.06
# at most, when there is much to catch up with; below the recorder's own, so that the count is ours
CHUNK_TICKS = 256
_STDERR = 2


@dataclass(frozen=True, slots=True)
class Recorded:
    """What became of a recording.

    result, reason: as in the log's metadata; `recording_failed` with the first error when the log
        could not be written.
    ticks: in the log, at least. lost: messages that the ring overwrote before they were read.
    """

    result: str
    reason: str
    ticks: int
    lost: int


class RingRecorder:
    """Takes over what is new in a ring, and goes on taking when the log cannot be written any more.

    A gap (the ring went round faster than the log was written) is a status `recording_gap` at the
    last tick before it.
    """

    def __init__(
        self,
        ring: Ring,
        recorder: McapRecorder,
        *,
        announce: bool = False,
        say: Callable[[str], None] | None = None,
    ):
        """Read `ring` from here on into `recorder`.

        announce: tell every change of state. say: takes lines for the user, without their end;
        stderr without waiting by default.
        """
        self._reader = RingReader(ring)
        self._recorder = recorder
        self._announce = announce
        self._say = say or tell
        self._flushed = -1.0
        # ticks read, ticks in the log, messages known to be lost
        self._taken = self._kept = self._lost = 0
        self._latest = 0.0  # s; time of the last tick read
        self._failure = ""
        self._end: StateChange | None = None

    def step(self, now: float) -> Recorded | None:
        """Take over what is new at `now` (s, monotonic).

        The outcome once the loop has said its END.
        """
        for kind, data in self._reader.messages():
            # what is overwritten is so by something newer, before which it is told
            self._tell_gap()
            self._take(kind, data)
        if self._end is not None:
            return self._close(self._end.state, self._end.reason)
        if now >= self._flushed + FLUSH_S:
            self._flush()
            self._flushed = now
        return None

    def orphaned(self) -> Recorded:
        """The loop is gone and said no END: finish the log all the same."""
        reason = f"the loop ended without a word after {self._latest:.3f} s"
        self._status(StateChange(self._latest, "stopped", reason))
        return self._close("loop_killed", reason)

    def _take(self, kind: int, data: bytes) -> None:
        if kind == TICK:
            self._taken += 1
            self._latest = numbers(data)[0]
            self._try(lambda: self._recorder.append_live(data))
            if self._taken - self._kept >= CHUNK_TICKS and not self._failure:
                self._flush()
        elif kind == STATUS:
            self._status(status(data))
        elif kind == END:
            self._end = status(data)

    def _status(self, new: StateChange) -> None:
        self._try(lambda: self._recorder.status(new.time, new.state, new.reason))
        if self._announce:
            self._say(f"{new.time:7.2f} s  {new.state}  {new.reason}".rstrip())

    def _tell_gap(self) -> None:
        lost, self._lost = self._reader.lost - self._lost, self._reader.lost
        if lost:
            self._status(
                StateChange(
                    self._latest,
                    "recording_gap",
                    f"{lost} messages lost: the log is written too slowly",
                )
            )

    def _flush(self) -> None:
        self._try(self._recorder.flush)
        if not self._failure:
            self._kept = self._taken

    def _close(self, result: str, reason: str) -> Recorded:
        if self._lost:
            told = f"{self._lost} messages lost: the log was written too slowly"
            reason = f"{reason}; {told}" if reason else told
        self._flush()
        self._try(lambda: self._recorder.close(result, reason))
        if self._failure:
            return Recorded("recording_failed", self._failure, self._kept, self._lost)
        return Recorded(result, reason, self._kept, self._lost)

    def _try(self, write: Callable[[], None]) -> None:
        """Write unless that has failed before; tell the first failure at once."""
        if self._failure:
            return
        try:
            write()
        except OutputError as error:
            self._failure = str(error)
            self._recorder.abandon()
            self._say(f"{self._latest:7.2f} s  nothing more is recorded: {error}")


def tell(line: str) -> None:
    """A line to stderr, if that takes it at once: nobody who fails to read it shall hold up a recording."""
    _, ready, _ = select.select([], [_STDERR], [], 0.0)
    if ready:
        with suppress(OSError):
            os.write(_STDERR, f"{printable(line)}\n".encode())
