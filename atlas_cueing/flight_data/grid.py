"""The grid k dt that a flight stands on, and samples brought onto it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array
from .flight_map import MAX_RATE_HZ, MIN_RATE_HZ
from .spline_fit import Curve, fit_curve, sample_spacing
from .stamps import Series

# s; how far stamps may lie from a grid and be called on it: whole us, and as much again
ON_GRID = 2e-6
_CUSTOMARY_HZ = (10, 20, 25, 30, 40, 50, 60, 80, 100, 120, 125, 150, 200, 240, 250, 400, 500, 1000)
_NEAR = 0.02
_ROUNDED = 1.01  # of half the last digit of a stamp
_MOST_OFF = 0.1  # of a step: stamps rounded more coarsely say nothing about a grid
_MARGIN = 2.0  # samples; there a curve at content of a tenth of the rate may be 2e-3 off
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

    Otherwise it is that of the customary rate within 2 % of its own, or of its own, rounded to
    three digits; always of a rate that a platform is driven at.
    """
    time = series.time
    mean = (time[-1] - time[0]) / (len(time) - 1)
    median = sample_spacing(time)
    # the mean is the better one where no sample is missing
    close = 0.01 * median + 2.0 * float(series.rounding.max())
    rate = 1.0 / (mean if abs(mean - median) < close else median)
    for digits in _DIGITS:
        step = 1.0 / round(rate, digits) if round(rate, digits) > 0.0 else 0.0
        if step and _offset(series, step) is not None:
            return _within(step)
    if _offset(series, 1.0 / rate) is not None:
        return _within(1.0 / rate)
    usual = min(_CUSTOMARY_HZ, key=lambda customary: abs(customary - rate))
    near = abs(usual - rate) <= _NEAR * rate
    return _within(1.0 / (usual if near else float(f"{rate:.3g}")))


def lay_grid(parts: Sequence[Series], first: Series, step: float) -> Grid:
    """Lay a grid of `step`, s, within the times that all parts cover.

    It begins on a sample of `first`, so that samples can be taken as they are. Where that cannot be
    for all parts, it keeps two samples away from the ends, where a curve is less certain.
    """
    begin = max(float(series.time[0]) for series in parts)
    end = min(float(series.time[-1]) for series in parts)
    grid = _from_sample(first, begin, end, step)
    if all(_exact(series, grid) is not None for series in parts):
        return grid
    margin = _MARGIN * max(sample_spacing(series.time) for series in parts)
    return _from_sample(first, begin + margin, end - margin, step)


def _from_sample(series: Series, begin: float, end: float, step: float) -> Grid:
    """Lay a grid from a sample of the series on, or from where it stood before it was rounded."""
    k = min(int(np.searchsorted(series.time, begin - ON_GRID)), len(series.time) - 1)
    start, offset = float(series.time[k]), _offset(series, step)
    if offset is not None:
        start = offset + step * round((start - offset) / step)
    slack = max(ON_GRID, float(series.rounding[-1]))
    return Grid(start, step, max(int(np.floor((end - start + slack) / step)) + 1, 0))


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


def _exact(series: Series, grid: Grid) -> NDArray[np.intp] | None:
    """Return the sample of each time of the grid; None unless samples and grid are the same."""
    if grid.count < 1:
        return None
    step = (series.time[-1] - series.time[0]) / (len(series.time) - 1)
    if abs(step - grid.step) > 0.01 * grid.step:
        return None  # of faster samples, those between would be left out, and so aliased
    times = grid.times
    nearest = np.searchsorted(series.time, times - 0.5 * grid.step)
    if nearest[-1] >= len(series.time):
        return None
    off = np.abs(series.time[nearest] - times)
    return nearest if np.all(off <= 2.0 * _tolerance(series, grid.step)[nearest]) else None


def _offset(series: Series, step: float) -> float | None:
    """Return the time, s, of a point of the grid of `step` that all samples lie on.

    Every stamp may be off by as much as it was rounded. None where there is no such grid.
    """
    first = float(series.time[0])
    off = series.time - first - step * np.rint((series.time - first) / step)
    allowed = _tolerance(series, step)
    least, most = float(np.max(off - allowed)), float(np.min(off + allowed))
    return first + min(max(0.0, least), most) if least <= most else None


def _tolerance(series: Series, step: float) -> Array:
    rounded: Array = np.clip(_ROUNDED * series.rounding, ON_GRID, _MOST_OFF * step)
    return rounded


def _within(step: float) -> float:
    return min(max(step, 1.0 / MAX_RATE_HZ), 1.0 / MIN_RATE_HZ)
