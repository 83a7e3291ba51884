"""How long a run is."""

from math import inf

import numpy as np

from .run_columns import RunColumns


class Duration:
    """Ticks of a run and the time from the first to the last, s; both 0 without ticks."""

    def __init__(self) -> None:
        """Begin without ticks."""
        self._ticks, self._first, self._last = 0, inf, -inf

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        self._ticks += len(block.time)
        self._first = float(np.minimum(self._first, np.min(block.time)))
        self._last = float(np.maximum(self._last, np.max(block.time)))

    def figures(self) -> dict[str, float]:
        """Ticks and duration of all blocks so far."""
        return {
            "ticks": float(self._ticks),
            "duration_s": self._last - self._first if self._ticks else 0.0,
        }
