"""How good the cueing was: every figure of a flight."""

import numpy as np

from .cost import cost
from .deviation import deviation, extra_rate
from .effort import effort
from .flight import Flight
from .likeness import likeness
from .turning import turning


def metrics(flight: Flight) -> dict[str, float]:
    """All figures of a flight, the most telling first, each with its unit in the name; correlations and turns have none.

    Shares are 0 to 1 of the ticks. The definitions stand with the functions: `deviation` (force, direction, rate and attitude
    error), `cost`, `extra_rate`, `likeness` (perceived errors; correlation, delay, missing, false, scaled cues of each axis),
    `turning` (Coriolis exposure, net turns), `effort` (smoothing and actuators); ticks and duration_s close the list.

    Every figure is a finite float when the columns are finite; a flight without ticks gives zeros.
    """
    return {
        **deviation(flight),
        **cost(flight),
        **extra_rate(flight),
        **likeness(flight),
        **turning(flight),
        **effort(flight),
        "ticks": float(len(flight.time)),
        "duration_s": float(np.ptp(flight.time)) if len(flight.time) else 0.0,
    }
