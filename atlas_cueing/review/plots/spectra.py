"""Plot of the power spectra of what pilot and rider feel."""

from typing import Any

import numpy as np
from plotly.subplots import make_subplots

from ..recorded_run import RecordedRun
from .downsample import thinned
from .style import DEGREES, FELT, VEHICLE, line, styled

# s; resolves 0.05 Hz (assumed: half the lowest frequency that motion cueing is tested at)
SEGMENT = 20.0
DECADES = 10.0  # of power shown below the largest; under that is rounding


def spectra(run: RecordedRun) -> Any:
    """Power spectra of specific force and rate, vehicle and rider, summed over the axes.

    By Welch's method with segments of `SEGMENT`.
    """
    from scipy.signal import welch

    flight = run.flight
    titles = ["specific force, (m/s²)²/Hz", "angular rate, (°/s)²/Hz"]
    figure = make_subplots(rows=1, cols=2, subplot_titles=titles)
    pairs = (
        (1, 1.0, flight.vehicle_f_B, flight.felt_f),
        (2, DEGREES, flight.vehicle_w_B, flight.felt_w),
    )
    fair = len(flight.time) > 8 and 0.0 < run.step < np.inf
    length = min(len(flight.time), max(round(SEGMENT / run.step), 8)) if fair else 0
    for column, factor, vehicle, felt in pairs if fair else ():
        most = 0.0
        for name, values, colour in (("vehicle", vehicle, VEHICLE), ("rider", felt, FELT)):
            hertz, power = welch(
                factor * np.nan_to_num(values), 1.0 / run.step, nperseg=length, axis=0
            )
            total = power[1:].sum(axis=1)
            kept = thinned(total[:, None])
            figure.add_trace(
                line(hertz[1:][kept], total[kept], name, colour, legend=column == 1),
                row=1,
                col=column,
            )
            most = max(most, float(total.max()))
        if 0.0 < most < np.inf:
            top = np.log10(most) + 0.5
            figure.update_yaxes(range=[top - DECADES, top], row=1, col=column)
    figure.update_xaxes(type="log", title_text="Hz", dtick=1)
    figure.update_yaxes(type="log", exponentformat="power", dtick=2)
    return styled(figure, height=380)
