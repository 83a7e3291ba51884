"""What a live run puts into its ring, and who reads it: ticks, changes of state and the end."""

import json
from struct import Struct

from ..signals import LIVE_ROW, StateChange, Tick, Timing, live_row
from .ring import Ring

TICK, STATUS, END = 1, 2, 3
LONGEST_TEXT = 240  # characters of a state or reason; of a longer one the beginning is kept
_row = Struct(f"={LIVE_ROW}d")
# a character takes at most 6 bytes as JSON, and few do
_SIZE = max(_row.size, 3 * (2 * LONGEST_TEXT + 60))


def live_ring(seconds: float, rate: float) -> Ring:
    """A ring that holds the last `seconds` of a run of `rate` Hz, and the changes of state among them."""
    return Ring(max(256, round(1.1 * seconds * rate)), _SIZE)


class LiveWriter:
    """The loop's end of the ring; no call waits for anybody."""

    def __init__(self, ring: Ring) -> None:
        self._ring = ring

    def tick(self, tick: Tick, timing: Timing) -> None:
        """Hand on one tick."""
        self._ring.write(TICK, _row.pack(*live_row(tick, timing)))

    def status(self, time: float, state: str, reason: str) -> None:
        """Hand on a change of state at `time` (s)."""
        self._ring.write(STATUS, _text(time, state, reason))

    def end(self, time: float, result: str, reason: str) -> None:
        """Nothing comes after this."""
        self._ring.write(END, _text(time, result, reason))


def numbers(data: bytes) -> tuple[float, ...]:
    """The row of a TICK (`signals.live_row`)."""
    return _row.unpack(data)


def status(data: bytes) -> StateChange:
    """The content of a STATUS, or of an END with the result as its state."""
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
