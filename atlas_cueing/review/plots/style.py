"""Colours, lines and layout that all plots share."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ...rotations import Array

VEHICLE, FELT, BAND, FAULT = "#1f4e79", "#d9730d", "rgba(217,115,13,0.22)", "#c00000"
AXES = ("#00796b", "#8e44ad", "#b8860b")  # wheels 1, 2, 3 and axes x, y, z
SERIES = ("#1f4e79", "#d9730d", "#2e8b57", "#8e44ad", "#b8860b", "#5f6b7a")  # runs side by side
ROW = 200  # pixels
GAP = 54  # pixels between rows: ticks of the one above, title of the one below
DEGREES = 180.0 / np.pi
# of the unit shown: a smaller value is rounding, and would be drawn as large as a signal where
# nothing else is
NOISE = 1e-9


def line(x: Array, y: Array, name: str, colour: str, *, legend: bool) -> Any:
    """A line through (x, y), (n,) each, in single precision, which is more than a screen shows."""
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
    """HTML of a text in the colour of its line, for a title that serves as a legend."""
    return f"<span style='color:{colour}'><b>{text}</b></span>"


def styled(figure: Any, *, height: int, rows: bool = False) -> Any:
    """Give the figure the layout of all others, `height` pixels high.

    rows: whether it has rows over one time axis, with titles to the left and time at each row.
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


def time_rows(titles: Sequence[str]) -> Any:
    """A figure of empty rows over one time axis, with their titles."""
    spacing = GAP / (ROW * len(titles))
    figure = make_subplots(
        rows=len(titles), cols=1, shared_xaxes=True, vertical_spacing=spacing, subplot_titles=titles
    )
    figure.update_xaxes(title_text="time, s", row=len(titles), col=1)
    return figure


def without_noise(values: Array) -> Array:
    """The values with those that are only rounding set to 0."""
    return np.where(np.abs(values) < NOISE, 0.0, values)
