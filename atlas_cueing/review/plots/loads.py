"""Plots of what a run asks of contacts and drives."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray

from ...rotations import Array
from ..checks.logged_loads import logged_loads
from ..recorded_run import RecordedRun
from .downsample import thinned
from .style import AXES, FAULT, ROW, coloured, line, styled, time_rows

MOST_SLIPS = 200  # intervals that are shaded
_HIGHEST_USE = 2.0  # drawn; a wheel that lifts off has any use
_SLIP = "rgba(192,0,0,0.14)"
_OUT, _BACK = "#b23b00", "#2e7d32"
_WHEELS = ("wheel 1", "wheel 2", "wheel 3")


def loads_over_time(run: RecordedRun) -> Any:
    """Traction use with slip shaded, normal force, torque, power and energy over one time axis."""
    loads, time = logged_loads(run), run.flight.time
    wheels = ", ".join(coloured(name, AXES[k]) for k, name in enumerate(_WHEELS))
    both = f"{coloured('to the motion', _OUT)}, {coloured('back from it', _BACK)}"
    titles = [
        f"traction use, share of the friction, slip shaded: {wheels}",
        f"normal force, N: {wheels}",
        f"torque at the axle, N m: {wheels}",
        f"power of all wheels, W: {both}",
        f"energy of each wheel for itself, summed, J: {both}",
    ]
    figure = time_rows(titles)
    _each(figure, 1, time, np.minimum(loads["use"], _HIGHEST_USE))
    figure.add_hline(y=1.0, line_color=FAULT, line_dash="dot", line_width=1.2, row=1, col=1)
    _each(figure, 2, time, loads["n"])
    _each(figure, 3, time, loads["t"])
    drive = run.platform.drive
    if drive and drive.torque_n_m is not None:
        for side in (drive.torque_n_m, -drive.torque_n_m):
            figure.add_hline(
                y=side, line_color=FAULT, line_dash="dot", line_width=1.2, row=3, col=1
            )
    _power(figure, time, loads["p"])
    _shade(figure, time, np.any((loads["use"] > 1.0) | (loads["n"] <= 0.0), axis=1))
    return styled(figure, height=ROW * len(titles), rows=True)


def torque_and_speed(run: RecordedRun) -> Any:
    """Torque of each wheel against its speed, inside the envelope of its drive if it is known."""
    loads, speed, figure = logged_loads(run), run.flight.wheel_speed, go.Figure()
    for k, name in enumerate(_WHEELS):
        kept = thinned(np.column_stack([speed[:, k], loads["t"][:, k]]))
        figure.add_trace(
            go.Scatter(
                x=np.asarray(speed[kept, k], dtype=np.float32),
                y=np.asarray(loads["t"][kept, k], dtype=np.float32),
                mode="markers",
                name=name,
                marker={"color": AXES[k], "size": 3},
            )
        )
    envelope = _envelope(run)
    if envelope is not None:
        figure.add_shape(
            type="rect",
            x0=-envelope[0],
            x1=envelope[0],
            y0=-envelope[1],
            y1=envelope[1],
            line={"color": FAULT, "dash": "dot", "width": 1.2},
        )
    figure.update_xaxes(title_text="wheel speed, rad/s")
    figure.update_yaxes(title_text="torque at the axle, N m")
    return styled(figure, height=460).update_layout(hovermode="closest")


def _envelope(run: RecordedRun) -> tuple[float, float] | None:
    """Largest speed (rad/s) and torque (N m) of a drive at its axle; None if not both are known."""
    drive = run.platform.drive
    if drive is None or drive.torque_n_m is None or drive.motor_speed_rad_s is None:
        return None
    return drive.motor_speed_rad_s / (drive.gear or 1.0), drive.torque_n_m


def _each(figure: Any, row: int, time: Array, values: Array) -> None:
    """Add a row with a line for each wheel (n, 3)."""
    for k, name in enumerate(_WHEELS):
        kept = thinned(values[:, k : k + 1])
        trace = line(time[kept], values[kept, k], name, AXES[k], legend=False)
        figure.add_trace(trace.update(hovertemplate=f"{name} %{{y}}<extra></extra>"), row, 1)


def _power(figure: Any, time: Array, power: Array) -> None:
    """Add the rows of power, filled to its sign, and of energy."""
    together = power.sum(axis=1)
    flows = (np.maximum(power, 0.0).sum(axis=1), np.maximum(-power, 0.0).sum(axis=1))
    parts = (np.maximum(together, 0.0), np.minimum(together, 0.0))
    names = zip(flows, parts, (_OUT, _BACK), ("to the motion", "back from it"), strict=True)
    for flow, part, colour, name in names:
        kept = thinned(part[:, None])
        trace = line(time[kept], part[kept], name, colour, legend=False)
        figure.add_trace(trace.update(fill="tozeroy"), 4, 1)
        steps = 0.5 * (flow[1:] + flow[:-1]) * np.diff(time)
        energy = np.concatenate([np.zeros(min(len(flow), 1)), np.cumsum(steps)])
        kept = thinned(energy[:, None])
        figure.add_trace(line(time[kept], energy[kept], name, colour, legend=False), 5, 1)


def _shade(figure: Any, time: Array, slipping: NDArray[np.bool_]) -> None:
    """Shade the intervals in which a wheel slips, in the first row."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], slipping, [False]]).astype(np.int8)))
    for begin, end in edges.reshape(-1, 2)[:MOST_SLIPS].tolist():
        figure.add_shape(
            type="rect",
            xref="x",
            yref="y domain",
            x0=float(time[begin]),
            x1=float(time[min(end, len(time) - 1)]),
            y0=0,
            y1=1,
            layer="below",
            fillcolor=_SLIP,
            line_width=0,
        )
