"""Plot of how punctual a live run was."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from ...rotations import Array
from ..checks.deadlines import timing
from ..recorded_run import RecordedRun
from .downsample import thinned
from .style import SERIES, coloured, line, styled

_BINS = 120


def punctuality(run: RecordedRun) -> Any:
    """Histogram of lateness and tick cost, and these, input age and missed deadlines over time."""
    late, cost, age, missed = (
        coloured(name, SERIES[k])
        for k, name in enumerate(("lateness", "tick cost", "input age", "missed"))
    )
    titles = [
        f"how many ticks: {late}, {cost}",
        "over time, µs",
        f"{age}, ms, and deadlines {missed}",
    ]
    figure = make_subplots(rows=1, cols=3, subplot_titles=titles)
    for k, (name, field) in enumerate((("lateness", "lateness_s"), ("tick cost", "cost_s"))):
        values = 1e6 * timing(run, field)
        counts, edges = _histogram(values)
        bars = go.Bar(
            x=edges, y=counts, name=name, legendgroup=name, marker_color=SERIES[k], opacity=0.6
        )
        figure.add_trace(bars, row=1, col=1)
        _add(figure, 2, run.flight.time, values, name, SERIES[k])
    _add(figure, 3, run.flight.time, 1e3 * timing(run, "input_age_s"), "input age", SERIES[0])
    _add(figure, 3, run.flight.time, timing(run, "missed_deadlines"), "missed", SERIES[1])
    figure.update_xaxes(type="log", title_text="µs", row=1, col=1)
    figure.update_yaxes(type="log", row=1, col=1)
    for column in (2, 3):
        figure.update_xaxes(title_text="time, s", row=1, col=column)
    return styled(figure, height=380).update_layout(barmode="overlay", bargap=0.0)


def _histogram(values: Array) -> tuple[Array, Array]:
    """Counts and lower edges of logarithmic bins from 1 us to 0.1 s, for values (n,) in us."""
    edges = np.geomspace(1.0, 1e5, _BINS + 1)
    counts, _ = np.histogram(np.clip(values, edges[0], edges[-1]), edges)
    return counts.astype(np.float64), edges[:-1]


def _add(figure: Any, column: int, time: Array, values: Array, name: str, colour: str) -> None:
    kept = thinned(values[:, None])
    figure.add_trace(line(time[kept], values[kept], name, colour, legend=False), row=1, col=column)
