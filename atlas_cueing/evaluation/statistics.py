"""Figures of columns that come block by block.

Of no values at all they are zero, so that every figure is a number.
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
        """Of no values yet."""
        self.components: Array = np.zeros(3)

    def add(self, v: Array) -> None:
        """Take in the rows that follow, of which there may be none."""
        if len(v):
            self.components = np.maximum(
                self.components, np.maximum(np.max(v, axis=0), 0.0 - np.min(v, axis=0))
            )

    @property
    def largest(self) -> float:
        """Over all components."""
        return float(np.max(self.components))


class Magnitudes:
    """Root mean square and maximum of magnitudes x (n,), as exact as sums of doubles are."""

    def __init__(self) -> None:
        """Of no values yet."""
        self.count = 0
        self.largest = 0.0
        self._squares = 0.0

    def add(self, x: Array) -> None:
        """Take in the values that follow, of which there may be none."""
        if len(x):
            self.count += len(x)
            self.largest = float(np.maximum(self.largest, np.max(x)))  # NaN stays NaN
            # vdot would wake a thread for each core
            self._squares += float(np.einsum("i,i->", x, x))

    @property
    def rms(self) -> float:
        """Root mean square."""
        return float(np.sqrt(self._squares / self.count)) if self.count else 0.0


class Spread(Magnitudes):
    """Magnitudes with quantiles, for which every value is kept, in single precision.

    That is all that grows with a flight: 4 bytes a tick, 14 MB for an hour at 1 kHz. A quantile is
    good to 6e-8 of itself; what is larger than 3e38 counts as infinite.
    """

    def __init__(self) -> None:
        """Of no values yet."""
        super().__init__()
        self._kept = bytearray()  # grows in place

    def add(self, x: Array) -> None:
        """Take in the values that follow."""
        super().add(x)
        with np.errstate(over="ignore"):
            self._kept += x.astype(np.float32).data

    def quantile(self, share: float, counted: NDArray[np.bool_] | None = None) -> float:
        """The value that this share (0 to 1) of the values does not exceed, interpolated.

        Of those `counted` (count,) only.
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
        """Rms, 95 % quantile and maximum: `<name>_rms_<unit>`, `<name>_p95_<unit>`, `<name>_max_<unit>`."""
        return {
            f"{name}_rms_{unit}": self.rms,
            f"{name}_p95_{unit}": self.quantile(0.95),
            f"{name}_max_{unit}": self.largest,
        }
