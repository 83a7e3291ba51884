"""Bound on the rounding of recorded times."""

import numpy as np

from ...rotations import Array

COARSEST = 1e-6  # s; stamps of microseconds are rounded by half of it, coarser ones are no rounding


def rounding(time: Array) -> Array:
    """Bound (n,), s, on the rounding of times (n,), s, that are multiples of one step but for it.

    Stamps rounded to whole ns or us, or kept as seconds since 1970 in a double (119 ns), are off an
    even grid by a quarter of their resolution in the middle and half of it at most; so four times
    the median is enough, and one odd tick does not raise it. Sums of k steps are off by k roundings
    of a double.
    """
    ticks = np.arange(len(time), dtype=np.float64)
    finite = np.nan_to_num(time)
    step = (finite[-1] - finite[0]) / (len(time) - 1) if len(time) > 1 else 0.0
    typical = float(np.median(np.abs(finite - finite[0] - ticks * step))) if len(time) else 0.0
    bound: Array = min(4.0 * typical, COARSEST) + ticks * np.spacing(np.abs(finite))
    return bound
