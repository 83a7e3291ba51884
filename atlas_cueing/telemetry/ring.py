"""The last seconds of a live run, in memory shared between processes.

One process writes and never waits; any number of others read, each at its own pace. A reader that
falls behind by more than the ring holds loses the oldest messages and counts them. The memory
is anonymous and reaches the readers by `fork`: it has no name, so nothing is left behind when a
process is killed, and what was written can still be read when the writer is gone.

Each slot begins with the number of its message, written last and invalidated first (a sequence
lock): a reader that finds another number before or after its copy has been overtaken.
"""

# mypyc: runs every tick

import mmap
from collections.abc import Iterator
from struct import Struct

_number = Struct("=Q")
_head = Struct("=QQI")  # message number, kind, size
_PAGE = mmap.PAGESIZE


class Ring:
    """A bounded memory of messages (kind, bytes)."""

    def __init__(self, slots: int, size: int) -> None:
        """Allocate `slots` messages of at most `size` bytes.

        All of the memory is touched now, so that no write faults a page in.
        """
        self.slots, self.size = slots, size
        self._stride = -(-(_head.size + size) // 8) * 8
        self._memory = mmap.mmap(-1, _PAGE + slots * self._stride)
        self._memory.write(bytes(len(self._memory)))
        self._written = 0

    @property
    def written(self) -> int:
        """Number of messages written up to now, in any process."""
        return int(_number.unpack_from(self._memory, 0)[0])

    def write(self, kind: int, data: bytes) -> None:
        """Keep one message in the place of the oldest. Raises ValueError when it is too long."""
        if len(data) > self.size:
            raise ValueError(f"message of {len(data)} bytes, allowed: at most {self.size}")
        at = self._place(self._written)
        self._written += 1
        _number.pack_into(self._memory, at, 0)
        self._memory[at + _head.size : at + _head.size + len(data)] = data
        _head.pack_into(self._memory, at, self._written, kind, len(data))
        _number.pack_into(self._memory, 0, self._written)

    def read(self, number: int) -> tuple[int, bytes] | None:
        """Return kind and content of message `number` (the first is 0).

        It is None when it has been overwritten or is not there yet.
        """
        at = self._place(number)
        found, kind, size = _head.unpack_from(self._memory, at)
        if found != number + 1 or size > self.size:
            return None
        data = self._memory[at + _head.size : at + _head.size + size]
        return (kind, data) if _number.unpack_from(self._memory, at)[0] == number + 1 else None

    def _place(self, number: int) -> int:
        return _PAGE + number % self.slots * self._stride


class RingReader:
    """Reads a ring from its next message on.

    lost: messages that were overwritten before they were read.
    """

    def __init__(self, ring: Ring) -> None:
        self._ring = ring
        self._next = ring.written
        self.lost = 0

    def messages(self) -> Iterator[tuple[int, bytes]]:
        """Yield the messages written since the last call, in order."""
        end = self._ring.written
        while self._next < end:
            # the very oldest may be about to be overwritten
            oldest = self._ring.written - self._ring.slots + 1
            if self._next < oldest:
                self.lost += oldest - self._next
                self._next = oldest
                continue
            message = self._ring.read(self._next)
            self._next += 1
            if message is None:
                self.lost += 1
            else:
                yield message

    def newest(self) -> Iterator[tuple[int, bytes]]:
        """Yield the newest messages since the last call, in order.

        All but the last slots / 2 are passed over and not counted as lost.
        """
        self._next = max(self._next, self._ring.written - self._ring.slots // 2)
        return self.messages()
