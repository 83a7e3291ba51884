"""Plot of a run over time: what was asked, what was felt, and what it took."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go

from ...printable import html_text
from ...rotations import Array
from ..checks.run_status import state_intervals
from ..finding import Finding
from ..recorded_run import RecordedRun
from ..verdict import Review
from .downsample import thinned
from .style import (
    AXES,
    BAND,
    DEGREES,
    FAULT,
    FELT,
    ROW,
    VEHICLE,
    coloured,
    line,
    styled,
    time_rows,
    without_noise,
)

MOST_MARKS = 200  # findings, and intervals of a state, marked on the time axis
_FORCES = ("x (forward)", "y (right)", "z (down)")
_RATES = ("x (roll to the right)", "y (pitch up)", "z (yaw to the right)")
_WHEELS = ("wheel 1", "wheel 2", "wheel 3")
_STATE = "rgba(90,106,122,0.16)"


def over_time(found: Review) -> Any:
    """Forces, rates, wheels, stage and flags of a run over one time axis.

    All rows share its zoom, and findings and states are marked across them.
    """
    titles = _titles()
    figure = time_rows(titles)
    _add_felt(figure, found.run)
    _add_actuators(figure, found.run)
    _shade(figure, found.run)
    _mark(figure, found.findings)
    return styled(figure, height=ROW * len(titles), rows=True)


def _titles() -> list[str]:
    """Titles of the rows, with the colours of wheels and axes in them."""
    wheels = ", ".join(coloured(name, AXES[k]) for k, name in enumerate(_WHEELS))
    axes = ", ".join(coloured(a, c) for a, c in zip("xyz", AXES, strict=True))
    return [
        *(f"specific force {axis}, m/s²" for axis in _FORCES),
        *(f"angular rate {axis}, °/s" for axis in _RATES),
        "angle between the specific forces of vehicle and rider, °",
        f"wheel speed, rad/s: {wheels}",
        f"wheel acceleration, rad/s²: {wheels}",
        f"stage position, m (platform base): {axes}",
        "limited: smoothing could not give what was asked",
    ]


def _add_felt(figure: Any, run: RecordedRun) -> None:
    """Add rows 1 to 7: forces, rates and the angle between the forces, of vehicle and rider."""
    flight = run.flight
    rates = DEGREES * flight.vehicle_w_B, DEGREES * flight.felt_w
    for k in range(3):
        _pair(figure, k + 1, flight.time, flight.vehicle_f_B[:, k], flight.felt_f[:, k])
        _pair(figure, k + 4, flight.time, *(rate[:, k] for rate in rates))
    angle = DEGREES * run.log.column("/felt", "direction_error_rad")[: len(flight.time), None]
    _lines(figure, 7, flight.time, angle, {"angle": FELT})


def _add_actuators(figure: Any, run: RecordedRun) -> None:
    """Add rows 8 to 11: wheels and stage within their limits, and where they were limited."""
    flight = run.flight
    speeds, stage = run.platform.wheel_limit_values(), run.platform.stage_limit_values()
    wheels, axes = (dict(zip(names, AXES, strict=True)) for names in (_WHEELS, "xyz"))
    _lines(figure, 8, flight.time, flight.wheel_speed, wheels, speeds.speed)
    _lines(figure, 9, flight.time, flight.wheel_acceleration, wheels, speeds.acceleration)
    _lines(figure, 10, flight.time, flight.motion_p_W, axes, stage.travel)
    _flags(figure, 11, flight.time, flight.limited, ("wheels", "stage"))


def _pair(figure: Any, row: int, time: Array, vehicle: Array, felt: Array) -> None:
    """Add a row with vehicle and rider (n,), the error between them filled."""
    vehicle, felt = without_noise(vehicle), without_noise(felt)
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
    """Add a row with a line for each column of `values` (n, k), and their limits dotted.

    colours: of the columns, by name; limits: of each column. A limit has the colour of its line
    where no other column has the same limit.
    """
    values = without_noise(values)
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


def _flags(figure: Any, row: int, time: Array, flags: Array, names: Sequence[str]) -> None:
    """Add a row with a lane for each flag (n, k), filled while it is 1."""
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
    """Shade the intervals of states that are not calm, through all rows."""
    intervals = state_intervals(run)[:MOST_MARKS]
    last = float(run.flight.time[-1]) if len(run.flight.time) else 0.0
    box = {
        "type": "rect",
        "xref": "x",
        "yref": "paper",
        "y0": 0,
        "y1": 1,
        "layer": "below",
        "fillcolor": _STATE,
        "line_width": 0,
    }
    for begin, end, _ in intervals:
        figure.add_shape(**box, x0=begin, x1=last if end is None else end)
    if intervals:
        key = {"symbol": "square", "size": 11, "color": _STATE}
        figure.add_trace(
            go.Scatter(
                x=[None], y=[None], mode="markers", marker=key, name="state other than running"
            ),
            1,
            1,
        )


def _mark(figure: Any, findings: Sequence[Finding]) -> None:
    """Mark each finding by a line through all rows, and its text in the first row."""
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
