"""Figures of one column: of no values at all they are zero, so that every figure of every flight is a number."""

from collections.abc import Callable

import numpy as np

from .flight import Array

_ROWS = 1 << 14  # rows at a time: their temporaries stay in the cache, and an hour of ticks needs no memory of its own


def length(v: Array) -> Array:
    """Euclidean lengths (n,) of the rows of v (n, k)."""
    norms: Array = np.sqrt(np.einsum("ij,ij->i", v, v))
    return norms


def by_rows(function: Callable[..., Array], *columns: Array) -> Array:
    """What `function` makes of columns of n rows, row by row: (n,) or (n, k), a few thousand rows at a time."""
    starts = range(0, max(len(columns[0]), 1), _ROWS)
    return np.concatenate([function(*(column[start : start + _ROWS] for column in columns)) for start in starts])


def rms(x: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.einsum("i,i->", x, x) / len(x))) if len(x) else 0.0  # vdot would wake a thread for each core


def mean(x: Array) -> float:
    """Mean."""
    return float(np.mean(x)) if len(x) else 0.0


def quantile(x: Array, share: float) -> float:
    """The value that this share (0 to 1) of the values does not exceed, interpolated."""
    return float(np.quantile(x, share)) if len(x) else 0.0


def largest(x: Array) -> float:
    """Largest magnitude, over all axes."""
    return float(max(np.max(x), -np.min(x))) if x.size else 0.0


def spread(name: str, unit: str, x: Array) -> dict[str, float]:
    """Rms, 95 % quantile and maximum of magnitudes x (n,): `<name>_rms_<unit>`, `<name>_p95_<unit>`, `<name>_max_<unit>`."""
    return {f"{name}_rms_{unit}": rms(x), f"{name}_p95_{unit}": quantile(x, 0.95), f"{name}_max_{unit}": largest(x)}
