"""Plot of the paths of stage and cabin in space."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ...rotations import Array
from ..own_rotations import turned
from ..recorded_run import RecordedRun
from .downsample import thinned
from .style import AXES, styled

_TRAVEL, _STAGE, _BALL = "#9aa5b1", "#1b2733", "#c8d3df"
_EYE = {"x": -1.35, "y": -1.35, "z": 0.9}  # from behind on the right: forward is away, left is left


def in_space(run: RecordedRun) -> Any:
    """The stage's path in its travel, and the directions of the cabin's nose and crown.

    A dot marks where each path begins.
    """
    flight, travel = run.flight, np.array(run.platform.stage_limit_values().travel)
    titles = ["stage in its travel, m", "directions of the cabin's nose and crown"]
    figure = make_subplots(
        rows=1, cols=2, specs=[[{"type": "scene"}, {"type": "scene"}]], subplot_titles=titles
    )
    figure.add_trace(_path(_box(travel), "travel", _TRAVEL), row=1, col=1)
    figure.add_trace(_ball(), row=1, col=2)
    paths = [(flight.motion_p_W, "stage", _STAGE, 1)]
    for name, axis, colour in (
        ("nose", (1.0, 0.0, 0.0), AXES[0]),
        ("crown", (0.0, 0.0, 1.0), AXES[2]),
    ):
        tips = turned(flight.motion_q_WS, np.array(axis)) if len(flight.time) else np.empty((0, 3))
        paths.append((tips, name, colour, 2))
    for points, name, colour, column in paths:
        figure.add_trace(_path(points[thinned(points)], name, colour), row=1, col=column)
        figure.add_trace(
            _path(points[:1], name, colour).update(mode="markers", marker_size=5, showlegend=False),
            1,
            column,
        )
    figure.update_scenes(aspectmode="data", camera_eye=_EYE)
    figure.update_scenes(xaxis_title="x forward", yaxis_title="y left", zaxis_title="z up")
    return styled(figure, height=560).update_layout(legend_y=-0.08)


def _box(half: Array) -> Array:
    """Points of a line along all edges of a box of half sizes (3,), along some of them twice."""
    x, y, z = half
    base = [(-x, -y), (x, -y), (x, y), (-x, y), (-x, -y)]
    corners = [(*c, -z) for c in base] + [(*c, z) for c in base]
    for c in base[1:4]:
        corners += [(*c, z), (*c, -z), (*c, z)]
    return np.array(corners)


def _path(points: Array, name: str, colour: str) -> Any:
    x, y, z = np.asarray(points, dtype=np.float32).T
    return go.Scatter3d(
        x=x,
        y=y,
        z=z,
        mode="lines",
        name=name,
        line={"color": colour, "width": 4},
        marker_color=colour,
    )


def _ball() -> Any:
    """A faint sphere on which the directions lie."""
    u, v = np.meshgrid(np.linspace(0.0, 2.0 * np.pi, 33), np.linspace(0.0, np.pi, 17))
    x, y, z = (
        np.asarray(c, dtype=np.float32)
        for c in (np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v))
    )
    colours = [[0, _BALL], [1, _BALL]]
    return go.Surface(
        x=x, y=y, z=z, opacity=0.25, showscale=False, colorscale=colours, hoverinfo="skip"
    )
