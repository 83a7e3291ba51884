"""Do two signals have the same shape, and how late is one of them?"""

from math import inf

import numpy as np

from .flight import Array

WINDOW = 0.5
"""Largest delay that is looked for, s (assumed): several times what a rider takes for the same motion; at most a quarter of
the record, so that most of it is compared at any shift."""

_BLOCK = 1 << 13  # ticks a transform; the sum of the blocks' spectra is the spectrum of the sum
_FLAT = 1e-12  # of a correlation: shifts this close to the best fit as well (a ramp fits at any)


def correlation(reference: Array, delayed: Array, dt: float, smallest: float = 0.0) -> tuple[float, float]:
    """Peak of the normalised cross-correlation of two signals (n,) and the delay (s) at which it stands.

    At every shift within +-`WINDOW` the correlation is Pearson's, with means and variances of the ticks that overlap at that
    shift, so that a pure delay gives 1 at the delay whatever the signal does at its ends. The peak is interpolated by a
    parabola through three ticks; a delay at the end of the window has no peak inside it. Where shifts fit equally well, the
    smallest is taken. The delay is positive when `delayed` is late. Ticks are `dt` (s) apart.

    (0, 0) when one of the signals does not vary (its standard deviation is at most `smallest`), when there is no overlap, and
    when the numbers are none.
    """
    if not 0.0 < dt < inf:  # of a log whose times are none
        return 0.0, 0.0
    most = min(round(WINDOW / dt), len(reference) // 4)
    if not _varies(reference, smallest) or not _varies(delayed, smallest):
        return 0.0, 0.0
    values = _pearson(_standardised(reference), _standardised(delayed), most)
    if not np.all(np.isfinite(values)):
        return 0.0, 0.0
    shift = _best(values) - most
    peak, offset = _peak(values, shift + most)
    return min(max(peak, -1.0), 1.0), (shift + offset) * dt


def _varies(x: Array, smallest: float) -> bool:
    if len(x) < 2:
        return False
    rounding = 1e-12 * float(np.max(np.abs(x)))
    return float(np.std(x)) > max(smallest, rounding)


def _standardised(x: Array) -> Array:
    centred: Array = x - np.mean(x)
    return centred / np.std(centred)


def _pearson(v: Array, p: Array, most: int) -> Array:
    """Pearson's correlation (2 most + 1,) of v[t] with p[t + shift] over the overlap, for shifts from -most to most."""
    overlap = len(v) - np.abs(np.arange(-most, most + 1))
    # With a shift to the right the end of v and the beginning of p hang over.
    mean_v, square_v = (np.concatenate([_without_head(x, most)[:0:-1], _without_head(x[::-1], most)]) for x in (v, v * v))
    mean_p, square_p = (np.concatenate([_without_head(x[::-1], most)[:0:-1], _without_head(x, most)]) for x in (p, p * p))
    covariance = _products(v, p, most) - mean_v * mean_p / overlap
    variances = (square_v - mean_v * mean_v / overlap) * (square_p - mean_p * mean_p / overlap)
    still = variances <= 1e-18 * len(v) ** 2  # what varies hangs over: there is nothing to compare
    values: Array = np.where(still, 0.0, covariance / np.sqrt(np.where(still, 1.0, variances)))
    return values


def _without_head(x: Array, most: int) -> Array:
    """Sums of x without its first 0, 1, ... most values, (most + 1,)."""
    return np.sum(x) - np.concatenate([[0.0], np.cumsum(x[:most])])


def _products(v: Array, p: Array, most: int) -> Array:
    """Sums over t of v[t] p[t + shift] for shifts from -most to most, by transforms of blocks: n log(block) operations."""
    size = 1 << (max(_BLOCK, 4 * most) - 1).bit_length()
    step = size - 2 * most
    total = np.zeros(size // 2 + 1, dtype=np.complex128)
    for start in range(0, len(v), step):
        before, after = max(start - most, 0), min(start + step + most, len(p))
        ahead = np.zeros(size)
        ahead[before - start + most : after - start + most] = p[before:after]
        total += np.conj(np.fft.rfft(v[start : start + step], size)) * np.fft.rfft(ahead)
    return np.fft.irfft(total, size)[: 2 * most + 1]


def _best(values: Array) -> int:
    """Place of the largest value, nearest to the middle among equals."""
    best = np.flatnonzero(values >= np.max(values) - _FLAT)
    return int(best[np.argmin(np.abs(best - len(values) // 2))])


def _peak(values: Array, k: int) -> tuple[float, float]:
    """Height of the parabola's vertex through three neighbours, and its distance from the middle one, at most one tick."""
    if not 0 < k < len(values) - 1:
        return float(values[k]), 0.0
    before, here, after = values[k - 1 : k + 2].tolist()
    bend, tilt = before - 2.0 * here + after, 0.5 * (after - before)
    if bend >= -1e-13:  # rounding of the correlations: flat
        return here, 0.0
    offset = min(max(-tilt / bend, -1.0), 1.0)
    return here + 0.5 * tilt * offset, offset
