"""Rows of axes over one time: specific force on the left, angular rate on the right."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...rotations import Array
from ..plots.downsample import thinned
from .paper_figure import WIDTH

DEGREES = 180.0 / np.pi
_ROW = 1.35  # in
_MARGIN = 0.85  # in; legend above, time below
_LEGEND, _KEY = 105, 8  # characters of a line of the legend, and as many as a key takes
_ROOM = 0.06  # of the range, above and below the lines
_LEAST_RANGE = (0.2, 1.0)  # m/s^2, deg/s: below it, rounding would look like a signal
_FORCES = ("x forward, m/s²", "y right, m/s²", "z down, m/s²")
_RATES = ("x roll, °/s", "y pitch, °/s", "z yaw, °/s")


def grid_of_axes(rows: int) -> tuple[Any, Any]:
    """Return a figure and its axes (rows, 2); the first three rows have titles and labels."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, _ROW * rows + _MARGIN), layout="constrained")
    axes = figure.subplots(rows, 2, sharex=True)
    axes[0, 0].set_title("Specific force at the head")
    axes[0, 1].set_title("Angular rate")
    for k in range(3):
        axes[k, 0].set_ylabel(_FORCES[k])
        axes[k, 1].set_ylabel(_RATES[k])
    for bottom in axes[-1]:
        bottom.set_xlabel("time, s")
    figure.align_ylabels(axes)
    return figure, axes


def draw_six(axes: Any, time: Array, force: Array, rate: Array, **line: Any) -> list[Any]:
    """Draw a force (n, 3), m/s^2, and a rate (n, 3), rad/s; return the lines, the first one named.

    line: of matplotlib, and `label`, which only the first line gets.
    """
    label = line.pop("label", "")
    drawn = []
    for column, values in enumerate((force, DEGREES * rate)):
        for k in range(3):
            drawn += draw(axes[k, column], time, values[:, k], **line)
    drawn[0].set_label(label)
    return drawn


def draw(axis: Any, time: Array, values: Array, **line: Any) -> list[Any]:
    """Draw values (n,) over time (n,), at most a few thousand of them, with every peak."""
    kept = thinned(values[:, None])
    lines: list[Any] = axis.plot(time[kept], values[kept], **line)
    return lines


def fit_limits(axes: Any, time: Array) -> None:
    """Let the first three rows begin and end with the flight, with room above and below."""
    if len(time) > 1:
        axes[0, 0].set_xlim(float(time[0]), float(time[-1]))
    for row in axes[:3]:
        for axis, least in zip(row, _LEAST_RANGE, strict=True):
            axis.set_ylim(*_range([line.get_ydata() for line in axis.get_lines()], least))


def _range(values: Sequence[Any], least: float) -> tuple[float, float]:
    """Lowest and highest of the finite numbers, at least so far apart, and some room."""
    every = np.concatenate([np.asarray(each, np.float64) for each in values])
    finite = every[np.isfinite(every)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
    half = max(0.5 * (high - low) * (1.0 + 2.0 * _ROOM), 0.5 * least)
    middle = 0.5 * (low + high)
    return middle - half, middle + half


def head(figure: Any, lines: Sequence[Any]) -> None:
    """Put one legend above all axes."""
    longest = max(len(str(line.get_label())) for line in lines)
    columns = max(min(len(lines), _LEGEND // (longest + _KEY)), 1)
    figure.legend(handles=list(lines), loc="outside upper center", ncols=columns, columnspacing=1.2)
