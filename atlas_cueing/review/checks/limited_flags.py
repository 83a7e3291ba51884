"""Check of the flags that say when smoothing could not give what was asked."""

import numpy as np

from ..finding import Finding, exceeding
from ..own_rotations import inverse, product, to_vector
from ..recorded_run import RecordedRun

# smoothing calls a lag of 0.01 deg met, and one of 0.1 mm: a hundredth is room for rounding
ANGLE = np.radians(0.0101)
DISTANCE = 1.01e-4  # m


def check_limited_flags(run: RecordedRun) -> list[Finding]:
    """Find ticks at which the motion lags behind the cue although the flag is 0."""
    flight = run.flight
    free = flight.limited == 0.0
    turn = np.linalg.norm(to_vector(product(flight.cue_q_WS, inverse(flight.motion_q_WS))), axis=1)
    lag = flight.cue_p_W - flight.motion_p_W
    check, places = (
        "lags behind the cue and is not called limited",
        [f"/motion p{c}_m" for c in "xyz"],
    )
    return [
        *exceeding(
            check,
            ["/motion q_ws"],
            flight.time,
            np.where(free[:, 0], turn, 0.0),
            ANGLE,
            "rad",
            quantity="lag",
        ),
        *exceeding(
            check,
            places,
            flight.time,
            np.where(free[:, 1:], lag, 0.0),
            DISTANCE,
            "m",
            quantity="lag",
        ),
    ]
