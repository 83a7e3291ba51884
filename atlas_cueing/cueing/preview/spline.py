"""Cubic splines over a whole flight, sampled at its ticks: what a plan is made of.

Uniform cubic B-splines (de Boor, A Practical Guide to Splines, 1978). The curve is a weighted mean
of four control points, its slope one of three of their differences over the knot interval, its
second derivative runs straight from one second difference to the next, and its third is a third
difference over a whole interval. So bounds on control points and differences are bounds on the
curve at all times, and everything a plan needs is a sparse matrix of few diagonals.
"""

import numpy as np
from scipy.sparse import csc_array, diags_array, eye_array

from ...rotations import Array

_WEIGHTS = 4  # control points that shape the curve at one time


class Spline:
    """A curve over `ticks` ticks with knots every `interval` s, a whole number of ticks."""

    def __init__(self, ticks: int, dt: float, rate_hz: float) -> None:
        """Lay knots about 1 / rate_hz s apart over ticks of dt s.

        The first knot is the first tick; the last one is the last tick, or less than an interval
        after it.
        """
        each = max(1, round(1.0 / (rate_hz * dt)))
        intervals = max(1, -(-(ticks - 1) // each))
        self.ticks, self.interval, self.points = ticks, each * dt, intervals + 3
        self.ends_between_ticks = (ticks - 1) % each != 0 or ticks == 1
        tick = np.arange(ticks)
        self._first = np.minimum(tick // each, intervals - 1)
        s = self._share = tick / each - self._first
        self.value = self._sampled(
            (1 - s) ** 3 / 6,
            (3 * s**3 - 6 * s**2 + 4) / 6,
            (1 + 3 * (s + s**2 - s**3)) / 6,
            s**3 / 6,
        )
        slopes = (-((1 - s) ** 2) / 2, (3 * s**2 - 4 * s) / 2, (1 + 2 * s - 3 * s**2) / 2, s**2 / 2)
        self.slope = self._sampled(*slopes) / self.interval
        self.curvature = self._sampled(1 - s, 3 * s - 2, 1 - 3 * s, s) / self.interval**2

    def difference(self, order: int) -> csc_array:
        """Give the matrix (points - order, points) to divided differences of the control points.

        They bound the derivative of that order.
        """
        matrix: csc_array = csc_array(eye_array(self.points))
        for n in range(self.points, self.points - order, -1):
            matrix = csc_array(steps(n) @ matrix / self.interval)
        return matrix

    def straight(self) -> csc_array:
        """Give the matrix (ticks, points - 2) from second differences to the second derivative.

        It runs straight between knots.
        """
        s, rows = self._share, np.repeat(np.arange(self.ticks), 2)
        columns = (self._first[:, None] + np.arange(2)).ravel()
        return csc_array(
            (np.stack([1 - s, s], axis=1).ravel(), (rows, columns)),
            shape=(self.ticks, self.points - 2),
        )

    def _sampled(self, *weights: Array) -> csc_array:
        """Give the matrix (ticks, points) with these weights of the four points at each tick."""
        rows = np.repeat(np.arange(self.ticks), _WEIGHTS)
        columns = (self._first[:, None] + np.arange(_WEIGHTS)).ravel()
        return csc_array(
            (np.stack(weights, axis=1).ravel(), (rows, columns)), shape=(self.ticks, self.points)
        )


def steps(n: int) -> csc_array:
    """Give the matrix (n - 1, n) from n numbers to their differences."""
    return csc_array(diags_array([-1.0, 1.0], offsets=[0, 1], shape=(n - 1, n)))
