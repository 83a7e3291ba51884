"""The grid k dt that a flight stands on, and samples brought onto it."""

from dataclasses import dataclass

import numpy as np

from ..rotations import Array
from .flight_map import MAX_RATE_HZ, MIN_RATE_HZ
from .spline_fit import Curve, fit_curve
from .stamps import Series

# s; how far stamps may lie from a grid and be called on it: whole us, and as much again
ON_GRID = 2e-6
_DIGITS = (0, 1, 2, 3)  # after the point of a rate in Hz, tried in turn


@dataclass(frozen=True, slots=True)
class Grid:
    """Times start + k step, k = 0 to count - 1, in s since the file's first stamp."""

    start: float
    step: float
    count: int

    @property
    def times(self) -> Array:
        """Return all of them, (count,)."""
        times: Array = self.start + self.step * np.arange(self.count, dtype=np.float64)
        return times

    @property
    def end(self) -> float:
        """Return the last one."""
        return self.start + self.step * (self.count - 1)


@dataclass(frozen=True, slots=True)
class Resampled:
    """A series on a grid.

    values: (count, columns). exact: whether they are the samples themselves. curve: through the
    samples, where it was needed.
    """

    values: Array
    exact: bool
    curve: Curve | None = None


def natural_step(series: Series) -> float:
    """Return the step, s, of a series: exactly that of its stamps where they lie on a grid.

    Otherwise it is that of its median rate, rounded to three digits, within the rates that a
    platform is driven at.
    """
    time = series.time
    mean = (time[-1] - time[0]) / (len(time) - 1)
    median = float(np.median(np.diff(time)))
    # the mean is the better one where no sample is missing
    rate = 1.0 / (mean if abs(mean - median) < 0.01 * median else median)
    for digits in _DIGITS:
        step = 1.0 / round(rate, digits) if round(rate, digits) > 0.0 else 0.0
        if step and _off(time, time[0], step) <= ON_GRID:
            return _within(step)
    if _off(time, time[0], 1.0 / rate) <= ON_GRID:
        return _within(1.0 / rate)
    return _within(1.0 / float(f"{1.0 / median:.3g}"))


def lay_grid(begin: float, end: float, step: float) -> Grid:
    """Lay a grid from `begin` on that ends at `end` or before, s."""
    return Grid(begin, step, int(np.floor((end - begin) / step + 1e-6)) + 1)


def resample(series: Series, grid: Grid) -> Resampled:
    """Bring a series onto a grid that lies within its times.

    The samples are taken as they are where there is one for each time of the grid; otherwise from a
    curve through them, see `spline_fit`.
    """
    exact = _exact(series, grid)
    if exact is not None:
        return Resampled(series.values[exact], exact=True)
    curve = fit_curve(series.time, series.values, grid.step)
    return Resampled(
        curve.at(np.clip(grid.times, series.time[0], series.time[-1])), exact=False, curve=curve
    )


def _exact(series: Series, grid: Grid) -> np.ndarray | None:
    """Return the sample of each time of the grid; None unless samples and grid are the same."""
    step = float(np.median(np.diff(series.time)))
    if abs(step - grid.step) > 0.01 * grid.step:
        return None  # of faster samples, those between would be left out, and so aliased
    times = grid.times
    nearest = np.searchsorted(series.time, times - 0.5 * grid.step)
    if nearest[-1] >= len(series.time):
        return None
    off = np.abs(series.time[nearest] - times)
    return nearest if float(off.max()) <= ON_GRID else None


def _off(time: Array, start: float, step: float) -> float:
    """Return how far times lie from a grid at most, s, whose line goes through them at best."""
    off = time - start - step * np.rint((time - start) / step)
    return 0.5 * float(np.ptp(off))


def _within(step: float) -> float:
    return min(max(step, 1.0 / MAX_RATE_HZ), 1.0 / MIN_RATE_HZ)
