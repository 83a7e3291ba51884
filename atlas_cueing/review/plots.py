"""Plots of a run: what was asked, what was felt, what it took. The only place that knows plotly, with `page`."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from .actuators import limit_shares
from .finding import Array, Finding
from .recorded_run import RecordedRun
from .review import Review
from .rotations import turned
from .thinning import thinned

VEHICLE, FELT, BAND, FAULT = "#1f4e79", "#d9730d", "rgba(217,115,13,0.22)", "#c00000"
SERIES = ("#1f4e79", "#d9730d", "#2e8b57", "#8e44ad", "#b8860b", "#5f6b7a")
ROW = 190  # pixels
MOST_MARKS = 200  # findings marked on the time axis
DEGREES = 180.0 / np.pi
_AXES = "xyz"
_COLOURS = "wheel 1 blue, 2 orange, 3 green"


def over_time(found: Review) -> Any:
    """Everything along one time axis, whose zoom is shared by all rows; findings are marked across them."""
    run = found.run
    flight = run.flight
    titles = [
        *(f"specific force {a}, m/s² (cabin FRD)" for a in _AXES),
        *(f"angular rate {a}, °/s (cabin FRD)" for a in _AXES),
        "angle between vehicle's and rider's force, °",
        f"wheel speed, rad/s ({_COLOURS})",
        f"wheel acceleration, rad/s² ({_COLOURS})",
        "stage position, m (W; x blue, y orange, z green)",
        "limited: smoothing could not give what was asked (wheels blue, stage orange)",
    ]
    figure = make_subplots(rows=len(titles), cols=1, shared_xaxes=True, vertical_spacing=0.018, subplot_titles=titles)
    for k in range(3):
        _pair(figure, k + 1, flight.time, flight.vehicle_f_B[:, k], flight.felt_f[:, k])
        _pair(figure, k + 4, flight.time, DEGREES * flight.vehicle_w_B[:, k], DEGREES * flight.felt_w[:, k])
    angle = DEGREES * run.log.column("/felt", "direction_error_rad")[: len(flight.time), None]
    _lines(figure, 7, flight.time, angle, ["force direction"])
    wheels, stage = run.platform.wheel_speed_limits(), run.platform.stage_motion_limits()
    names = ["wheel 1", "wheel 2", "wheel 3"]
    _lines(figure, 8, flight.time, flight.wheel_speed, names, wheels.speed)
    _lines(figure, 9, flight.time, flight.wheel_acceleration, names, wheels.acceleration)
    _lines(figure, 10, flight.time, flight.motion_p_W, [f"stage {a}" for a in _AXES], stage.travel)
    _lines(figure, 11, flight.time, flight.limited, ["wheels", "stage"])
    _mark(figure, found.findings)
    figure.update_xaxes(title_text="time, s", row=len(titles), col=1)
    return styled(figure, height=ROW * len(titles))


def in_space(run: RecordedRun) -> Any:
    """The stage's path in its box, and where nose and crown of the cabin have pointed."""
    flight, travel = run.flight, np.array(run.platform.stage_motion_limits().travel)
    titles = ["stage in its travel, m (W)", "cabin's nose and crown on the sphere (W)"]
    figure = make_subplots(rows=1, cols=2, specs=[[{"type": "scene"}, {"type": "scene"}]], subplot_titles=titles)
    figure.add_trace(_path(_box(travel), "travel", "#9aa5b1"), row=1, col=1)
    path = flight.motion_p_W[thinned(flight.motion_p_W)]
    figure.add_trace(_path(path, "stage", SERIES[0]), row=1, col=1)
    figure.add_trace(_ball(), row=1, col=2)
    for name, axis, colour in (("nose", (1.0, 0.0, 0.0), SERIES[0]), ("crown", (0.0, 0.0, 1.0), SERIES[1])):
        tips = turned(flight.motion_q_WS, np.array(axis)) if len(flight.time) else np.empty((0, 3))
        figure.add_trace(_path(tips[thinned(tips)], name, colour), row=1, col=2)
    figure.update_scenes(aspectmode="data", xaxis_title="x", yaxis_title="y", zaxis_title="z")
    return styled(figure, height=560).update_layout(legend_y=-0.08)


def limit_bars(run: RecordedRun) -> Any:
    """Largest use of each limit by the logged values, in percent; one bar for each wheel or axis."""
    figure = go.Figure()
    shares = limit_shares(run)
    for k in range(3):
        used = [100.0 * float(np.max(np.abs(share[:, k]), initial=0.0)) for share in shares.values()]
        titles = [name.replace("_", " ") for name in shares]
        figure.add_trace(go.Bar(x=titles, y=used, name=f"wheel {k + 1} or stage {_AXES[k]}", marker_color=SERIES[k]))
    figure.add_hline(y=100.0, line_color=FAULT, line_dash="dash")
    figure.update_yaxes(title_text="% of the limit")
    return styled(figure, height=380)


def spectra(run: RecordedRun) -> Any:
    """Power spectra of specific force and rate, vehicle against rider, summed over the axes."""
    from scipy.signal import welch

    flight = run.flight
    titles = ["specific force, (m/s²)²/Hz", "angular rate, (°/s)²/Hz"]
    figure = make_subplots(rows=1, cols=2, subplot_titles=titles)
    pairs = (
        (1, 1.0, flight.vehicle_f_B, flight.felt_f),
        (2, DEGREES, flight.vehicle_w_B, flight.felt_w),
    )
    length = min(len(flight.time), 4096)
    for column, factor, vehicle, felt in pairs if length > 8 and 0.0 < run.step < np.inf else ():
        for name, values, colour in (("vehicle", vehicle, VEHICLE), ("rider", felt, FELT)):
            hertz, power = welch(factor * np.nan_to_num(values), 1.0 / run.step, nperseg=length, axis=0)
            trace = line(hertz[1:], power[1:].sum(axis=1), name, colour, legend=column == 1)
            figure.add_trace(trace, row=1, col=column)
    figure.update_xaxes(type="log", title_text="Hz")
    figure.update_yaxes(type="log", exponentformat="power")
    return styled(figure, height=380)


def overlays(names: Sequence[str], runs: Sequence[RecordedRun]) -> Any:
    """The rider less the pilot, run upon run: force, direction, rate, and what it took of the stage."""
    titles = ["force error, m/s²", "angle between the forces, °", "rate error, °/s", "stage away from the centre, m"]
    figure = make_subplots(rows=len(titles), cols=1, shared_xaxes=True, vertical_spacing=0.04, subplot_titles=titles)
    for k, (name, run) in enumerate(zip(names, runs, strict=True)):
        flight = run.flight
        columns = (
            np.linalg.norm(flight.felt_f - flight.vehicle_f_B, axis=1),
            DEGREES * run.log.column("/felt", "direction_error_rad")[: len(flight.time)],
            DEGREES * np.linalg.norm(flight.felt_w - flight.vehicle_w_B, axis=1),
            np.linalg.norm(flight.motion_p_W, axis=1),
        )
        for row, values in enumerate(columns, 1):
            kept = thinned(values[:, None])
            trace = line(flight.time[kept], values[kept], name, SERIES[k % len(SERIES)], legend=row == 1)
            figure.add_trace(trace, row=row, col=1)
    figure.update_xaxes(title_text="time, s", row=len(titles), col=1)
    return styled(figure, height=240 * len(titles))


def _pair(figure: Any, row: int, time: Array, vehicle: Array, felt: Array) -> None:
    """Vehicle and rider, with the error between them filled."""
    kept = thinned(np.column_stack([vehicle, felt]))
    figure.add_trace(line(time[kept], vehicle[kept], "vehicle", VEHICLE, legend=row == 1), row=row, col=1)
    trace = line(time[kept], felt[kept], "rider", FELT, legend=row == 1)
    figure.add_trace(trace.update(fill="tonexty", fillcolor=BAND), row=row, col=1)


def _lines(
    figure: Any, row: int, time: Array, values: Array, names: Sequence[str], limits: Sequence[float] | None = None
) -> None:
    """One line a column, and the limits of each dashed in its colour."""
    for k, name in enumerate(names):
        kept = thinned(values[:, k : k + 1])
        trace = line(time[kept], values[kept, k], name, SERIES[k], legend=False).update(hovertemplate=f"{name} %{{y}}")
        figure.add_trace(trace, row=row, col=1)
    for limit in sorted(set(limits or ())):
        for side in (limit, -limit):
            figure.add_hline(y=side, line_color=FAULT, line_dash="dot", line_width=1, row=row, col=1)


def line(x: Array, y: Array, name: str, colour: str, *, legend: bool) -> Any:
    """One line of single precision, which is more than a screen shows."""
    return go.Scatter(
        x=np.asarray(x, dtype=np.float32),
        y=np.asarray(y, dtype=np.float32),
        name=name,
        legendgroup=name,
        showlegend=legend,
        mode="lines",
        line={"color": colour, "width": 1.2},
    )


def _mark(figure: Any, findings: Sequence[Finding]) -> None:
    """A line through all rows at each finding, and a mark with its text on top of the first row."""
    timed = [finding for finding in findings if finding.time is not None][:MOST_MARKS]
    for time in sorted({finding.time for finding in timed if finding.time is not None}):
        stroke = {"color": FAULT, "width": 1}
        figure.add_shape(type="line", xref="x", yref="paper", x0=time, x1=time, y0=0, y1=1, line=stroke, opacity=0.6)
    if timed:
        figure.add_trace(
            go.Scatter(
                x=[finding.time for finding in timed],
                y=[0.0] * len(timed),
                text=[f"{finding.place}: {finding.check}" for finding in timed],
                hovertemplate="%{text}<br>%{x} s<extra></extra>",
                mode="markers",
                name="finding",
                marker={"color": FAULT, "size": 9, "symbol": "diamond"},
            ),
            row=1,
            col=1,
        )


def _box(half: Array) -> Array:
    """A line along all edges of a box (some twice)."""
    x, y, z = half
    base = [(-x, -y), (x, -y), (x, y), (-x, y), (-x, -y)]
    corners = [(*c, -z) for c in base] + [(*c, z) for c in base]
    for c in base[1:4]:
        corners += [(*c, z), (*c, -z), (*c, z)]
    return np.array(corners)


def _path(points: Array, name: str, colour: str) -> Any:
    x, y, z = np.asarray(points, dtype=np.float32).T
    return go.Scatter3d(x=x, y=y, z=z, mode="lines", name=name, line={"color": colour, "width": 4})


def _ball() -> Any:
    """A faint sphere, so that a path on it can be placed."""
    u, v = np.meshgrid(np.linspace(0.0, 2.0 * np.pi, 33), np.linspace(0.0, np.pi, 17))
    x, y, z = (np.asarray(c, dtype=np.float32) for c in (np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)))
    return go.Surface(
        x=x, y=y, z=z, opacity=0.25, showscale=False, colorscale=[[0, "#c8d3df"], [1, "#c8d3df"]], hoverinfo="skip"
    )


def styled(figure: Any, *, height: int) -> Any:
    """The figure in the manner of all others, `height` pixels high."""
    figure.update_layout(
        template="plotly_white",
        height=height,
        margin={"l": 60, "r": 20, "t": 60, "b": 40},
        legend={"orientation": "h", "yanchor": "bottom", "y": 1.0, "xanchor": "right", "x": 1.0},
        hovermode="x unified",
        font={"family": "system-ui, sans-serif", "size": 12},
    )
    figure.update_annotations(font_size=12, xanchor="left", x=0.0) if height > ROW * 4 else None
    return figure
