"""Correlation and delay of two signals: have they the same shape, and how late is one of them?"""

from math import inf

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array

WINDOW = 0.5
"""Largest delay that is looked for, s (assumed): several times what a rider takes for the same
motion; at most a quarter of the record, so that most of it is compared at any shift."""

MOST = 8192
"""Largest delay that is looked for, ticks: `WINDOW` up to 16 kHz. It bounds the memory for a log
with any step."""

# values, at least; the sum of the spectra of pieces is the spectrum of the sum
_TRANSFORM = 1 << 13
_FLAT = 1e-12  # of a correlation: shifts this close to the best fit as well (a ramp fits at any)
# of a variance: where no more is left in the overlap, what varies hangs over and there is nothing
# to compare
_STILL = 1e-12
# ticks: where the window ends amid two ticks, rounding of the step does not decide between them
_HALF = 1e-6


class Correlation:
    """Peak of the normalised cross-correlation of two signals, and the delay at which it stands.

    At every shift within +-`WINDOW` the correlation is Pearson's, with means and variances of the
    ticks that overlap at that shift, so that a pure delay gives 1 at the delay, however the signal
    begins and ends. The peak is interpolated by a parabola through three ticks; a delay at the end
    of the window has no peak inside it. Where shifts fit equally well, the smallest is taken. The
    delay is positive when `delayed` is late.

    Means and variances are from plain sums, of the signals less a constant c each: the mean of
    their first block. With m and s the mean and standard deviation of all n values, the squares of
    the first B of them alone give n s^2 >= B (c - m)^2, so (c - m)^2 / s^2 is at most n / B: over
    an hour at 1 kHz three of sixteen digits may cancel, and no more.
    """

    def __init__(self, dt: float, smallest: float = 0.0) -> None:
        """Begin without ticks.

        dt: time from tick to tick, s; smallest: the standard deviation up to which a signal counts
        as constant, in its own unit.
        """
        self._dt, self._smallest = dt, smallest
        self._window = min(round(WINDOW / dt - _HALF), MOST) if _step(dt) else 0
        size = 1 << (max(_TRANSFORM, 4 * self._window) - 1).bit_length()
        self._v, self._p = _Sums(self._window), _Sums(self._window)
        self._products = _Products(self._window, size)

    def add(self, reference: Array, delayed: Array) -> None:
        """Take in the next values, (n,) each."""
        if len(reference):
            self._products.add(self._v.centred(reference), self._p.centred(delayed))

    def peak(self) -> tuple[float, float]:
        """Peak, -1 to 1, and delay, s, of all values so far.

        (0, 0) when one of the signals does not vary, when nothing overlaps, and when a value is not
        finite.
        """
        if (
            not _step(self._dt)
            or not self._v.vary(self._smallest)
            or not self._p.vary(self._smallest)
        ):
            return 0.0, 0.0
        most = min(self._window, self._v.count // 4)
        values = self._pearson(most)
        if not np.all(np.isfinite(values)):
            return 0.0, 0.0
        shift = _best(values) - most
        peak, offset = _peak(values, shift + most)
        return min(max(peak, -1.0), 1.0), (shift + offset) * self._dt

    def _pearson(self, most: int) -> Array:
        """Pearson's correlation (2 most + 1,) of v[t] with p[t + shift] over their overlap.

        The shifts are -most to most, ticks.
        """
        v, p = self._v, self._p
        overlap = v.count - np.abs(np.arange(-most, most + 1))
        sum_v, square_v = v.overlapping(most)
        sum_p, square_p = (sums[::-1] for sums in p.overlapping(most))  # the other end hangs over
        covariance = self._products.sums(most) - sum_v * sum_p / overlap
        scatter_v, scatter_p = (
            square_v - sum_v * sum_v / overlap,
            square_p - sum_p * sum_p / overlap,
        )
        still = (scatter_v <= _STILL * v.scatter) | (scatter_p <= _STILL * p.scatter)
        values: Array = np.where(
            still, 0.0, covariance / np.sqrt(np.where(still, 1.0, scatter_v * scatter_p))
        )
        return values


def _step(dt: float) -> bool:
    """Whether a time can be a step: times of a damaged log may be any number."""
    return 0.0 < dt < inf


class _Sums:
    """Sums of a signal's values and of their squares, also without some values at an end.

    The values are taken less a constant, the mean of the first block.
    """

    def __init__(self, window: int) -> None:
        self.count, self._window = 0, window
        self._centre, self._largest = 0.0, 0.0
        self._sum, self._square = 0.0, 0.0
        self._head: Array = np.empty(0)
        self._tail: Array = np.empty(0)

    def centred(self, x: Array) -> Array:
        """Take in the next values (n,), and give them less the constant."""
        if not self.count:
            self._centre = float(np.mean(x))
        self._largest = float(max(self._largest, np.max(x), -np.min(x)))
        x = x - self._centre
        self.count += len(x)
        self._sum += float(np.sum(x))
        self._square += float(np.einsum("i,i->", x, x))
        if len(self._head) < self._window:
            self._head = np.concatenate([self._head, x[: self._window]])[: self._window]
        self._tail = (
            np.concatenate([self._tail, x])[-self._window :]
            if len(x) < self._window
            else x[len(x) - self._window :]
        )
        return x

    @property
    def scatter(self) -> float:
        """Sum of the squared differences from the mean."""
        return self._square - self._sum * self._sum / self.count

    def vary(self, smallest: float) -> bool:
        """Whether the standard deviation is larger than `smallest`, and than rounding."""
        if self.count < 2:
            return False
        least = max(smallest, 1e-12 * self._largest)
        return self.scatter > self.count * least * least

    def overlapping(self, most: int) -> tuple[Array, Array]:
        """Sums of values and of squares, (2 most + 1,), over what is left without some values.

        Left out are the first `most`, ... 2, 1, none, and the last 1, 2, ... `most`.
        """
        head, tail = self._head[:most], self._tail[::-1][:most]
        return _without(self._sum, head, tail), _without(self._square, head * head, tail * tail)


def _without(total: float, head: Array, tail: Array) -> Array:
    return total - np.concatenate([np.cumsum(head)[::-1], [0.0], np.cumsum(tail)])


class _Products:
    """Sums over t of v[t] p[t + shift] for shifts up to a window either way.

    By Fourier transforms of pieces, in n log(piece) operations. A piece is as long as a transform
    holds, with a window of p before it and one behind, for which it waits.
    """

    def __init__(self, window: int, size: int) -> None:
        self._window, self._size, self._step = window, size, size - 2 * window
        # of no piece yet; p from a window before v on
        self._v, self._p = np.empty(0), np.zeros(window)
        self._spectrum = np.zeros(size // 2 + 1, dtype=np.complex128)

    def add(self, v: Array, p: Array) -> None:
        """Take in the next values, (n,) each."""
        self._v, self._p = np.concatenate([self._v, v]), np.concatenate([self._p, p])
        while len(self._v) >= self._step + self._window:
            self._spectrum += self._piece(self._v, self._p)
            self._v, self._p = self._v[self._step :], self._p[self._step :]

    def sums(self, most: int) -> Array:
        """The sums for shifts from -most to most, (2 most + 1,), zeros behind the last values."""
        spectrum, p = self._spectrum.copy(), np.concatenate([self._p, np.zeros(self._window)])
        for start in range(0, len(self._v), self._step):
            spectrum += self._piece(self._v[start:], p[start:])
        shifts = np.fft.irfft(spectrum, self._size)
        return shifts[self._window - most : self._window + most + 1]

    def _piece(self, v: Array, p: Array) -> NDArray[np.complex128]:
        """Spectrum of the products of the first piece of v and p, which begins a window earlier."""
        return np.conj(np.fft.rfft(v[: self._step], self._size)) * np.fft.rfft(
            p[: self._size], self._size
        )


def _best(values: Array) -> int:
    """Index of the largest value, the nearest to the middle among equals."""
    best = np.flatnonzero(values >= np.max(values) - _FLAT)
    return int(best[np.argmin(np.abs(best - len(values) // 2))])


def _peak(values: Array, k: int) -> tuple[float, float]:
    """Vertex of the parabola through the value at k and its neighbours.

    Gives its height, and its distance from k in ticks, at most one.
    """
    if not 0 < k < len(values) - 1:
        return float(values[k]), 0.0
    before, here, after = values[k - 1 : k + 2].tolist()
    bend, tilt = before - 2.0 * here + after, 0.5 * (after - before)
    if bend >= -1e-13:  # rounding of the correlations: flat
        return here, 0.0
    offset = min(max(-tilt / bend, -1.0), 1.0)
    return here + 0.5 * tilt * offset, offset
