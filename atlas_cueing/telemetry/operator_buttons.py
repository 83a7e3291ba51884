"""The operator's buttons, in memory shared between processes.

They are pressed in one process and read in another, and neither waits. As the ring's, the memory is
anonymous and reaches the other process by `fork`.
"""

# mypyc: runs every tick

import mmap
from threading import Lock

BUTTONS = ("engage", "hold", "park", "reset", "stop")
_SIZE = 8 * len(BUTTONS)


class OperatorButtons:
    """A count of presses for each name of BUTTONS.

    One process presses, from any of its threads, and one process reads. A count is written and read
    as one aligned word, so that no count is seen half written.
    """

    def __init__(self) -> None:
        self._memory = mmap.mmap(-1, _SIZE)
        self._counts = memoryview(self._memory).cast("Q")
        self._seen = bytes(_SIZE)
        self._lock = Lock()

    def press(self, name: str) -> None:
        """Press a button. Raises ValueError for a name that is not in BUTTONS."""
        if name not in BUTTONS:
            raise ValueError(f"button {name!r}, allowed: {', '.join(BUTTONS)}")
        with self._lock:
            self._counts[BUTTONS.index(name)] += 1

    def edges(self) -> tuple[str, ...]:
        """Return the buttons pressed since the last call, in the order of BUTTONS.

        Each is returned once, however often it was pressed.
        """
        counts = self._memory[:_SIZE]
        if counts == self._seen:
            return ()
        before, self._seen = memoryview(self._seen).cast("Q"), counts
        now = memoryview(counts).cast("Q")
        return tuple(name for k, name in enumerate(BUTTONS) if now[k] != before[k])
