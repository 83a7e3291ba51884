"""Statistics of values that come block by block.

Those of no values at all are 0, so that every figure is a number.
"""

from math import isnan

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array, length


def distance(p: Array, q: Array) -> Array:
    """Lengths (n,) of the differences of the rows of p and q (n, k)."""
    return length(p - q)


class Peaks:
    """Largest magnitude of each component of a vector (n, 3)."""

    def __init__(self) -> None:
        """Begin without values."""
        self.components: Array = np.zeros(3)

    def add(self, v: Array) -> None:
        """Take in the next rows (n, 3), of which there may be none."""
        if len(v):
            self.components = np.maximum(
                self.components, np.maximum(np.max(v, axis=0), 0.0 - np.min(v, axis=0))
            )

    @property
    def largest(self) -> float:
        """Largest magnitude of any component."""
        return float(np.max(self.components))


class Magnitudes:
    """Root mean square and maximum of magnitudes x (n,), as exact as sums of doubles are."""

    def __init__(self) -> None:
        """Begin without values."""
        self.count = 0
        self.largest = 0.0
        self._squares = 0.0

    def add(self, x: Array) -> None:
        """Take in the next values (n,), of which there may be none."""
        if len(x):
            self.count += len(x)
            self.largest = float(np.maximum(self.largest, np.max(x)))  # NaN stays NaN
            # vdot would wake a thread for each core
            self._squares += float(np.einsum("i,i->", x, x))

    @property
    def rms(self) -> float:
        """Root mean square, 0 without values."""
        return float(np.sqrt(self._squares / self.count)) if self.count else 0.0


class Spread(Magnitudes):
    """Magnitudes with quantiles, for which every value is kept, in single precision.

    That is all that grows with a run: 4 bytes a tick, 14 MB for an hour at 1 kHz. A quantile is
    exact to 6e-8 of itself; a value larger than 3e38 counts as infinite.
    """

    def __init__(self) -> None:
        """Begin without values."""
        super().__init__()
        self._kept = bytearray()  # grows in place

    def add(self, x: Array) -> None:
        """Take in the next values (n,)."""
        super().add(x)
        with np.errstate(over="ignore"):
            self._kept += x.astype(np.float32).data

    def quantile(self, share: float, counted: NDArray[np.bool_] | None = None) -> float:
        """The value that this share (0 to 1) of the values does not exceed, interpolated.

        counted: which of the values (count,) are taken, all by default.
        """
        kept = np.frombuffer(self._kept, np.float32)
        values = kept.copy() if counted is None else kept[counted]
        if not len(values) or isnan(self.largest):
            return self.largest if len(values) else 0.0
        place = share * (len(values) - 1)
        below = int(place)
        above = min(below + 1, len(values) - 1)
        values.partition((below, above))
        low, high = float(values[below]), float(values[above])
        return min(low + (place - below) * (high - low) if high > low else low, self.largest)

    def figures(self, name: str, unit: str) -> dict[str, float]:
        """Rms, 95 % quantile and maximum as `<name>_rms_<unit>`, `..._p95_...`, `..._max_...`."""
        return {
            f"{name}_rms_{unit}": self.rms,
            f"{name}_p95_{unit}": self.quantile(0.95),
            f"{name}_max_{unit}": self.largest,
        }


class WorstWindow:
    """Largest mean of values x (n,), none of them negative, over a sliding window of ticks.

    Only the last window is kept. Sums over windows are differences of sums over a window and a
    block, so that they lose few digits.
    """

    def __init__(self, ticks: int) -> None:
        """Begin without values; `ticks` is the length of the window, at least 1."""
        self._ticks = ticks
        self._count = 0
        self._largest = 0.0  # sum over a whole window
        self._kept: Array = np.empty(0)

    def add(self, x: Array) -> None:
        """Take in the next values (n,), of which there may be none."""
        joined = np.concatenate([self._kept, x])
        self._count += len(x)
        self._kept = joined[max(len(joined) - self._ticks, 0) :]
        if self._count > self._ticks and len(x):
            self._largest = float(np.maximum(self._largest, _largest_sum(joined, self._ticks)))

    @property
    def mean(self) -> float:
        """Largest mean over a window; over all values while they fill no more than one."""
        if self._count > self._ticks:
            return self._largest / self._ticks
        return float(np.mean(self._kept)) if self._count else 0.0


def _largest_sum(x: Array, ticks: int) -> float:
    """Largest sum of so many neighbours in x (n,), n >= ticks; the sum of all if it is infinite."""
    sums = np.concatenate([[0.0], np.cumsum(x)])
    if not np.isfinite(sums[-1]):
        return float(sums[-1])
    return float(np.max(sums[ticks:] - sums[:-ticks]))
