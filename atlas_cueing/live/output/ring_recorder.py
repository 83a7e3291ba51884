"""Copies the ring of a live run into its log, so that what a kill can lose is bounded."""

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

# a tick goes to the disk after at most this and one poll: a kill loses less than 0.1 s
FLUSH_S = 0.06
SYNC_S = 1.0  # s between two requests that the disk takes what was written
# at most, when there is much to catch up with; fewer than in a chunk of the recorder's own
CHUNK_TICKS = 256
_STDERR = 2


@dataclass(frozen=True, slots=True)
class Recorded:
    """How a recording ended.

    result, reason: as in the log's metadata; `recording_failed` with the first error when the log
        could not be written.
    ticks: in the log, at least. lost: messages that the ring overwrote before they were read.
    """

    result: str
    reason: str
    ticks: int
    lost: int


class RingRecorder:
    """Moves messages from a ring into a log.

    It goes on reading the ring when the log cannot be written any more. A gap (the ring went round
    faster than the log was written) is a status `recording_gap` at the last tick before it.
    """

    def __init__(
        self,
        ring: Ring,
        recorder: McapRecorder,
        *,
        announce: bool = False,
        report: Callable[[str], None] | None = None,
    ):
        """Read `ring` from its next message on into `recorder`.

        Args:
            ring: of a live run.
            recorder: open, with `started_ns`.
            announce: report every change of state.
            report: takes lines for the user, without their end; by default they go to stderr
                without waiting.
        """
        self._reader = RingReader(ring)
        self._recorder = recorder
        self._announce = announce
        self._report = report or report_on_stderr
        self._flushed = self._synced = -1.0
        # ticks read, ticks in the log, messages known to be lost
        self._taken = self._kept = self._lost = 0
        self._latest = 0.0  # s; time of the last tick read
        self._failure = ""
        self._end: StateChange | None = None

    def step(self, now: float) -> Recorded | None:
        """Take over what is new at `now` (s, monotonic); return the outcome after the END."""
        for kind, data in self._reader.messages():
            # what overwrote the lost messages is newer than the gap
            self._record_gap()
            self._take(kind, data)
        if self._end is not None:
            return self._close(self._end.state, self._end.reason)
        if now >= self._flushed + FLUSH_S:
            self._flush()
            self._flushed = now
        if now >= self._synced + SYNC_S:
            self._try(self._recorder.sync)
            self._synced = now
        return None

    def orphaned(self) -> Recorded:
        """Finish the log of a loop that ended without an END in the ring."""
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
            self._report(f"{new.time:7.2f} s  {new.state}  {new.reason}".rstrip())

    def _record_gap(self) -> None:
        lost, self._lost = self._reader.lost - self._lost, self._reader.lost
        if lost:
            if not self._announce:
                self._report(f"{self._latest:7.2f} s  {lost} messages are not recorded")
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
            losses = f"{self._lost} messages lost: the log was written too slowly"
            reason = f"{reason}; {losses}" if reason else losses
        self._flush()
        self._try(lambda: self._recorder.close(result, reason))
        if self._failure:
            return Recorded("recording_failed", self._failure, self._kept, self._lost)
        return Recorded(result, reason, self._kept, self._lost)

    def _try(self, write: Callable[[], None]) -> None:
        """Write unless that has failed before; report the first failure at once."""
        if self._failure:
            return
        try:
            write()
        except OutputError as error:
            self._failure = str(error)
            self._recorder.abandon()
            self._report(f"{self._latest:7.2f} s  nothing more is recorded: {error}")


def report_on_stderr(line: str) -> None:
    """Write a line to stderr if it takes it at once, so that no reader holds up a recording."""
    _, ready, _ = select.select([], [_STDERR], [], 0.0)
    if ready:
        with suppress(OSError):
            os.write(_STDERR, f"{printable(line)}\n".encode())
