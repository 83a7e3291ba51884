"""The figures: one ride, and several rides beside the vehicle's flight."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...printable import printable
from ...rotations import Array
from ..comparison import Comparison, flights_differ
from ..recorded_run import RecordedRun
from .axes_grid import draw, draw_six, fit_limits, grid_of_axes, head
from .paper_figure import COLOURS, DASHES, THICK, THIN, VEHICLE, paper_style, save

_WHEELS = COLOURS[1:4]
_SHOWN_LIMIT = 0.25  # of a limit: who uses less sees the lines better without it
_CORNER = {"ha": "right", "va": "top", "fontsize": 7.0, "color": "#555555"}
_LIMIT = {"color": "#000000", "linewidth": 0.8, "linestyle": (0, (4, 2))}


def write_ride_figure(run: RecordedRun, file: str | Path) -> None:
    """Write the figure of one ride as SVG or PDF, by the ending of `file`.

    Vehicle and rider: specific force and angular rate, in the axes of the vehicle's body and of
    the cabin (forward, right, down); the wheels' speeds and accelerations against their limits.

    Raises MissingExtraError without matplotlib, InputError for another ending, and OutputError when
    the file cannot be written; an old one is kept then.
    """
    flight, limits = run.flight, run.platform.wheel_limit_values()
    with paper_style():
        figure, axes = grid_of_axes(4)
        lines = [_vehicle(axes, run, "vehicle")]
        rider = {"color": COLOURS[0], "linewidth": THIN, "label": "rider"}
        lines += draw_six(axes, flight.time, flight.felt_f, flight.felt_w, **rider)[:1]
        fit_limits(axes, flight.time)
        lines += _wheels(axes[3, 0], flight.time, flight.wheel_speed, limits.speed)
        _wheels(axes[3, 1], flight.time, flight.wheel_acceleration, limits.acceleration)
        axes[3, 0].set_ylabel("wheel speed, rad/s")
        axes[3, 1].set_ylabel("wheel acc., rad/s²")
        head(figure, lines)
        save(figure, Path(file))


def write_comparison_figure(comparison: Comparison, file: str | Path) -> None:
    """Write every ride and the vehicle's flight into each axis. Raises as `write_ride_figure`.

    Where the flights differ, each has a dotted line in the colour of its ride.
    """
    runs = [each.run for each in comparison.reviews]
    with paper_style():
        figure, axes = grid_of_axes(3)
        same = not any(flights_differ(runs[0], run) for run in runs[1:])
        lines = [_vehicle(axes, runs[0], "vehicle")] if same else []
        for k, (name, run) in enumerate(zip(comparison.names, runs, strict=True)):
            flight, colour = run.flight, COLOURS[k % len(COLOURS)]
            line = {"color": colour, "linewidth": THIN, "label": _label(name)}
            line["linestyle"] = DASHES[k // len(COLOURS) % len(DASHES)]
            lines += draw_six(axes, flight.time, flight.felt_f, flight.felt_w, **line)[:1]
            if not same:
                own = f"vehicle of {_label(name)}"
                lines.append(_vehicle(axes, run, own, colour=colour, linestyle=":"))
        fit_limits(axes, max((run.flight.time for run in runs), key=len))
        head(figure, lines)
        save(figure, Path(file))


def _vehicle(axes: Any, run: RecordedRun, label: str, colour: str = VEHICLE, **line: Any) -> Any:
    """Draw what the vehicle did, wide and behind the rides; return the line for the legend."""
    flight, width = run.flight, THICK if colour == VEHICLE else THIN
    line |= {"color": colour, "linewidth": width, "label": label, "zorder": 1.5}
    return draw_six(axes, flight.time, flight.vehicle_f_B, flight.vehicle_w_B, **line)[0]


def _wheels(axis: Any, time: Array, values: Array, limits: Sequence[float]) -> list[Any]:
    """Draw each wheel (n, 3), and the limits as lines, or told where they are far away."""
    lines = []
    for k, colour in enumerate(_WHEELS):
        wheel = {"color": colour, "linewidth": THIN, "label": f"wheel {k + 1}"}
        lines += draw(axis, time, values[:, k], **wheel)
    used = max(
        (float(np.max(np.abs(values[:, k]), initial=0.0)) / limits[k] for k in range(3)),
        default=0.0,
    )
    if used < _SHOWN_LIMIT:
        told = ", ".join(f"±{limit:g}" for limit in dict.fromkeys(limits))
        axis.text(0.99, 0.97, f"limit {told}", **_CORNER, transform=axis.transAxes)
        return lines
    for limit in dict.fromkeys(limits):
        for side in (-limit, limit):
            lines_of_limit = axis.axhline(side, **_LIMIT)
    lines_of_limit.set_label("limit")
    return [*lines, lines_of_limit]


def _label(name: str) -> str:
    """A name as plain text: matplotlib would take `$` for mathematics, and hide a leading `_`."""
    plain = printable(name).replace("$", r"\$")
    return f" {plain}" if plain.startswith("_") else plain
