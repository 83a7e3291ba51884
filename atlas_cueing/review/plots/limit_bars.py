"""Plot of the use of each limit."""

from typing import Any

import numpy as np
import plotly.graph_objects as go

from ..checks.actuators import limit_shares
from ..recorded_run import RecordedRun
from .style import AXES, FAULT, styled


def limit_bars(run: RecordedRun) -> Any:
    """Largest use of each limit in percent; one bar for each wheel or axis."""
    figure = go.Figure()
    shares = limit_shares(run)
    titles = [name.replace("_", " ") for name in shares]
    for k in range(3):
        used = [
            100.0 * float(np.max(np.abs(share[:, k]), initial=0.0)) for share in shares.values()
        ]
        name = f"wheel {k + 1} or stage {'xyz'[k]}"
        figure.add_trace(
            go.Bar(
                x=titles,
                y=used,
                name=name,
                marker_color=AXES[k],
                texttemplate="%{y:.1f}",
                textposition="auto",
            )
        )
    figure.add_hline(y=100.0, line_color=FAULT, line_dash="dash")
    figure.update_yaxes(title_text="% of the limit")
    return styled(figure, height=380)
