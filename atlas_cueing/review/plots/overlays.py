"""Plot of several runs over each other."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...printable import html_text
from ..recorded_run import RecordedRun
from .downsample import thinned
from .style import DEGREES, SERIES, line, styled, time_rows, without_noise


def overlays(names: Sequence[str], runs: Sequence[RecordedRun]) -> Any:
    """Errors of force, direction and rate, and the stage's distance, of all runs over time."""
    titles = [
        "specific force, rider less pilot, m/s² (magnitude)",
        "angle between the specific forces, °",
        "angular rate, rider less pilot, °/s (magnitude)",
        "stage's distance from the centre, m",
    ]
    figure = time_rows(titles)
    for k, (name, run) in enumerate(zip(names, runs, strict=True)):
        flight = run.flight
        columns = (
            np.linalg.norm(flight.felt_f - flight.vehicle_f_B, axis=1),
            DEGREES * run.log.column("/felt", "direction_error_rad")[: len(flight.time)],
            DEGREES * np.linalg.norm(flight.felt_w - flight.vehicle_w_B, axis=1),
            np.linalg.norm(flight.motion_p_W, axis=1),
        )
        for row, values in enumerate(columns, 1):
            values = without_noise(values)
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
