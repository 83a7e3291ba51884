"""The messages in the ring of a live run: ticks, changes of state and the end."""

# mypyc: runs every tick

import json
from struct import Struct
from typing import Protocol

from ..signals import ATTITUDE_ROW, LIVE_ROW, StateChange, Tick, Timing, live_row
from .ring import Ring

TICK, STATUS, END = 1, 2, 3
LONGEST_TEXT = 240  # characters of a state or reason; of a longer one the beginning is kept
_row, _attitude = Struct(f"={LIVE_ROW}d"), Struct(f"={ATTITUDE_ROW}d")
# a character takes at most 6 bytes as JSON, and few do
_SIZE = max(_row.size + _attitude.size, 3 * (2 * LONGEST_TEXT + 60))


def live_ring(seconds: float, rate: float) -> Ring:
    """Return a ring for the last `seconds` of a run of `rate` Hz, changes of state included."""
    return Ring(max(256, round(1.1 * seconds * rate)), _SIZE)


class Attitude(Protocol):
    """Whoever corrects the attitude of a run."""

    def row(self) -> tuple[float, ...]:
        """Return the ATTITUDE_ROW numbers of the last tick."""


class LiveWriter:
    """The loop's end of the ring; no call waits for a reader."""

    def __init__(self, ring: Ring, attitude: Attitude | None = None) -> None:
        """Write to `ring`; the numbers of `attitude` follow those of a tick."""
        self._ring, self._attitude = ring, attitude

    def tick(self, tick: Tick, timing: Timing) -> None:
        """Write one tick and its timing."""
        row = _row.pack(*live_row(tick, timing))
        if self._attitude:
            row += _attitude.pack(*self._attitude.row())
        self._ring.write(TICK, row)

    def status(self, time: float, state: str, reason: str) -> None:
        """Write a change of state at `time` (s)."""
        self._ring.write(STATUS, _text(time, state, reason))

    def end(self, time: float, result: str, reason: str) -> None:
        """Write the end of the run at `time` (s), its last message."""
        self._ring.write(END, _text(time, result, reason))


def numbers(data: bytes) -> tuple[float, ...]:
    """Return the row of a TICK (`signals.live_row`)."""
    return _row.unpack_from(data)


def status(data: bytes) -> StateChange:
    """Return the content of a STATUS, or of an END with the result as its state."""
    time, state, reason = json.loads(data)
    return StateChange(time, state, reason)


def _text(time: float, state: str, reason: str) -> bytes:
    data = json.dumps(
        [time, state[:LONGEST_TEXT], reason[:LONGEST_TEXT]], ensure_ascii=False
    ).encode(errors="replace")
    return (
        data
        if len(data) <= _SIZE
        else _text(time, state[: len(state) // 2], reason[: len(reason) // 2])
    )
