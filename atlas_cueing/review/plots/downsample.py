"""Downsampling of plots that keeps every peak."""

import numpy as np
from numpy.typing import NDArray

from ...rotations import Array

POINTS = 4000  # most points of one trace; a screen has half as many columns


def thinned(values: Array, points: int = POINTS) -> NDArray[np.int64]:
    """Indices, in order, of the rows of `values` (n, k) to draw, at most `points`.

    They are all rows when these are few; else the first, the last, and those where a column is
    lowest or highest in each of equal stretches. NaN counts as the lowest, so that a gap in the
    drawing stays.
    """
    n, k = values.shape
    if n <= points:
        return np.arange(n)
    stretches = (points - 2) // (2 * k)
    length = -(-n // stretches)
    padded = np.concatenate(
        [values, np.repeat(values[-1:], length * (-(-n // length)) - n, axis=0)]
    )
    blocks = np.where(np.isnan(padded), -np.inf, padded).reshape(-1, length, k)
    starts = length * np.arange(len(blocks))[:, None]
    places = np.concatenate(
        [starts + blocks.argmin(axis=1), starts + blocks.argmax(axis=1)], axis=1
    )
    return np.unique(np.concatenate([[0, n - 1], np.minimum(places.ravel(), n - 1)]))
