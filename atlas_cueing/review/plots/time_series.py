"""Plots over time: what was asked, what was felt, what it took.

Only the modules called plot know plotly, with `page`.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ...printable import html_text
from ...rotations import Array
from ..checks.status import spells
from ..finding import Finding
from ..recorded_run import RecordedRun
from ..verdict import Review
from .downsample import thinned

VEHICLE, FELT, BAND, FAULT = "#1f4e79", "#d9730d", "rgba(217,115,13,0.22)", "#c00000"
AXES = ("#00796b", "#8e44ad", "#b8860b")  # wheels 1, 2, 3 and axes x, y, z
SERIES = ("#1f4e79", "#d9730d", "#2e8b57", "#8e44ad", "#b8860b", "#5f6b7a")  # runs side by side
ROW = 200  # pixels
GAP = 54  # pixels between rows: ticks of the one above, title of the one below
MOST_MARKS = 200  # findings, and spells of a state, marked on the time axis
DEGREES = 180.0 / np.pi
# of the unit shown: what is smaller is rounding, and would be drawn as large as a signal where
# nothing else is
NOISE = 1e-9
_FORCES = ("x (forward)", "y (right)", "z (down)")
_RATES = ("x (roll to the right)", "y (pitch up)", "z (yaw to the right)")
_WHEELS = ("wheel 1", "wheel 2", "wheel 3")
_SPELL = "rgba(90,106,122,0.16)"


def over_time(found: Review) -> Any:
    """Everything along one time axis, whose zoom is shared by all rows.

    Findings and states are marked across them.
    """
    run = found.run
    flight = run.flight
    wheels = ", ".join(coloured(name, AXES[k]) for k, name in enumerate(_WHEELS))
    titles = [
        *(f"specific force {axis}, m/s²" for axis in _FORCES),
        *(f"angular rate {axis}, °/s" for axis in _RATES),
        "angle between the specific forces of vehicle and rider, °",
        f"wheel speed, rad/s: {wheels}",
        f"wheel acceleration, rad/s²: {wheels}",
        "stage position, m (platform base): "
        + ", ".join(coloured(a, c) for a, c in zip("xyz", AXES, strict=True)),
        "limited: smoothing could not give what was asked",
    ]
    figure = _rows(titles)
    for k in range(3):
        _pair(figure, k + 1, flight.time, flight.vehicle_f_B[:, k], flight.felt_f[:, k])
        _pair(
            figure,
            k + 4,
            flight.time,
            DEGREES * flight.vehicle_w_B[:, k],
            DEGREES * flight.felt_w[:, k],
        )
    angle = DEGREES * run.log.column("/felt", "direction_error_rad")[: len(flight.time), None]
    _lines(figure, 7, flight.time, angle, {"angle": FELT})
    speeds, stage = run.platform.wheel_limit_values(), run.platform.stage_limit_values()
    _lines(
        figure,
        8,
        flight.time,
        flight.wheel_speed,
        dict(zip(_WHEELS, AXES, strict=True)),
        speeds.speed,
    )
    _lines(
        figure,
        9,
        flight.time,
        flight.wheel_acceleration,
        dict(zip(_WHEELS, AXES, strict=True)),
        speeds.acceleration,
    )
    _lines(
        figure,
        10,
        flight.time,
        flight.motion_p_W,
        dict(zip("xyz", AXES, strict=True)),
        stage.travel,
    )
    _flags(figure, 11, flight.time, flight.limited, ("wheels", "stage"))
    _shade(figure, run)
    _mark(figure, found.findings)
    return styled(figure, height=ROW * len(titles), rows=True)


def overlays(names: Sequence[str], runs: Sequence[RecordedRun]) -> Any:
    """The rider less the pilot, run upon run: force, direction, rate, and what it took of the stage."""
    titles = [
        "specific force, rider less pilot, m/s² (magnitude)",
        "angle between the specific forces, °",
        "angular rate, rider less pilot, °/s (magnitude)",
        "stage's distance from the centre, m",
    ]
    figure = _rows(titles)
    for k, (name, run) in enumerate(zip(names, runs, strict=True)):
        flight = run.flight
        columns = (
            np.linalg.norm(flight.felt_f - flight.vehicle_f_B, axis=1),
            DEGREES * run.log.column("/felt", "direction_error_rad")[: len(flight.time)],
            DEGREES * np.linalg.norm(flight.felt_w - flight.vehicle_w_B, axis=1),
            np.linalg.norm(flight.motion_p_W, axis=1),
        )
        for row, values in enumerate(columns, 1):
            values = _quiet(values)
            kept = thinned(values[:, None])
            trace = line(
                flight.time[kept],
                values[kept],
                html_text(name),
                SERIES[k % len(SERIES)],
                legend=row == 1,
            )
            figure.add_trace(trace, row=row, col=1)
    return styled(figure, height=240 * len(titles), rows=True)


def line(x: Array, y: Array, name: str, colour: str, *, legend: bool) -> Any:
    """One line of single precision, which is more than a screen shows."""
    return go.Scatter(
        x=np.asarray(x, dtype=np.float32),
        y=np.asarray(y, dtype=np.float32),
        name=name,
        legendgroup=name,
        showlegend=legend,
        mode="lines",
        line={"color": colour, "width": 1.4},
    )


def coloured(text: str, colour: str) -> str:
    """Text in the colour of its line, for a title that stands for a legend."""
    return f"<span style='color:{colour}'><b>{text}</b></span>"


def styled(figure: Any, *, height: int, rows: bool = False) -> Any:
    """The figure in the manner of all others, `height` pixels high.

    With `rows`, titles to the left and time at each row.
    """
    figure.update_layout(
        template="plotly_white",
        height=height,
        margin={"l": 60, "r": 20, "t": 50, "b": 45},
        legend={"orientation": "h", "yanchor": "bottom", "y": 1.0, "xanchor": "right", "x": 1.0},
        hovermode="x unified",
        font={"family": "system-ui, sans-serif", "size": 12},
    )
    if rows:
        figure.update_annotations(font_size=13, xanchor="left", x=0.0)
        figure.update_xaxes(showticklabels=True, ticks="outside", tickcolor="rgba(0,0,0,0)")
    return figure


def _rows(titles: Sequence[str]) -> Any:
    """Empty rows over one time axis."""
    spacing = GAP / (ROW * len(titles))
    figure = make_subplots(
        rows=len(titles), cols=1, shared_xaxes=True, vertical_spacing=spacing, subplot_titles=titles
    )
    figure.update_xaxes(title_text="time, s", row=len(titles), col=1)
    return figure


def _pair(figure: Any, row: int, time: Array, vehicle: Array, felt: Array) -> None:
    """Vehicle and rider, with the error between them filled."""
    vehicle, felt = _quiet(vehicle), _quiet(felt)
    kept = thinned(np.column_stack([vehicle, felt]))
    figure.add_trace(
        line(time[kept], vehicle[kept], "vehicle", VEHICLE, legend=row == 1), row=row, col=1
    )
    trace = line(time[kept], felt[kept], "rider", FELT, legend=row == 1)
    figure.add_trace(trace.update(fill="tonexty", fillcolor=BAND), row=row, col=1)


def _lines(
    figure: Any,
    row: int,
    time: Array,
    values: Array,
    colours: dict[str, str],
    limits: Sequence[float] | None = None,
) -> None:
    """One line a column by name, and the limits dotted: in the line's colour where it is the only one with this limit."""
    values = _quiet(values)
    for k, (name, colour) in enumerate(colours.items()):
        kept = thinned(values[:, k : k + 1])
        trace = line(time[kept], values[kept, k], name, colour, legend=False)
        figure.add_trace(
            trace.update(hovertemplate=f"{name} %{{y}}<extra></extra>"), row=row, col=1
        )
    own = dict(zip(limits or (), colours.values(), strict=False))
    for limit, colour in own.items():
        ink = colour if list(limits or ()).count(limit) == 1 else FAULT
        for side in (limit, -limit):
            figure.add_hline(
                y=side, line_color=ink, line_dash="dot", line_width=1.2, row=row, col=1
            )


def _quiet(values: Array) -> Array:
    """Without what is only rounding."""
    return np.where(np.abs(values) < NOISE, 0.0, values)


def _flags(figure: Any, row: int, time: Array, flags: Array, names: Sequence[str]) -> None:
    """One lane a flag, filled while it is set."""
    for k, name in enumerate(names):
        kept = thinned(flags[:, k : k + 1])
        low = float(len(names) - 1 - k)
        figure.add_trace(
            line(time[kept], np.full(len(kept), low), name, AXES[k], legend=False).update(
                hoverinfo="skip"
            ),
            row,
            1,
        )
        trace = line(time[kept], low + 0.8 * flags[kept, k], name, AXES[k], legend=False)
        trace.update(
            fill="tonexty",
            line_shape="hv",
            customdata=flags[kept, k],
            hovertemplate="%{customdata:.0f}",
        )
        figure.add_trace(trace, row=row, col=1)
    places = [len(names) - 1 - k + 0.4 for k in range(len(names))]
    figure.update_yaxes(
        tickvals=places,
        ticktext=list(names),
        range=[-0.1, len(names)],
        showgrid=False,
        row=row,
        col=1,
    )


def _shade(figure: Any, run: RecordedRun) -> None:
    """Spells of other states than a calm one, grey through all rows."""
    told = spells(run)[:MOST_MARKS]
    last = float(run.flight.time[-1]) if len(run.flight.time) else 0.0
    box = {
        "type": "rect",
        "xref": "x",
        "yref": "paper",
        "y0": 0,
        "y1": 1,
        "layer": "below",
        "fillcolor": _SPELL,
        "line_width": 0,
    }
    for begin, end, _ in told:
        figure.add_shape(**box, x0=begin, x1=last if end is None else end)
    if told:
        key = {"symbol": "square", "size": 11, "color": _SPELL}
        figure.add_trace(
            go.Scatter(
                x=[None], y=[None], mode="markers", marker=key, name="state other than running"
            ),
            1,
            1,
        )


def _mark(figure: Any, findings: Sequence[Finding]) -> None:
    """A line through all rows at each finding, and a mark with its text on top of the first row."""
    timed = [finding for finding in findings if finding.time is not None][:MOST_MARKS]
    for time in sorted({finding.time for finding in timed if finding.time is not None}):
        stroke = {"color": FAULT, "width": 1}
        figure.add_shape(
            type="line",
            xref="x",
            yref="paper",
            x0=time,
            x1=time,
            y0=0,
            y1=1,
            line=stroke,
            opacity=0.6,
        )
    if timed:
        figure.add_trace(
            go.Scatter(
                x=[finding.time for finding in timed],
                y=[0.0] * len(timed),
                text=[html_text(f"{finding.place}: {finding.check}") for finding in timed],
                hovertemplate="%{text}<br>%{x} s<extra></extra>",
                mode="markers",
                name="finding",
                marker={"color": FAULT, "size": 9, "symbol": "diamond"},
            ),
            row=1,
            col=1,
        )
