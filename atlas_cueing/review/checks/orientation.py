"""Check of the orientation: is the sphere where its rate and its wheels have turned it?"""

import numpy as np

from ...rotations import Array
from ..finding import Finding, exceeding
from ..own_rotations import cross, from_vector, inverse, product, to_vector, turned_back
from ..recorded_run import RecordedRun
from .integrals import TURN, turn

NORM = 1e-9  # quaternions are renormalised to 1e-15 each tick
ROUNDING = 1e-10  # rad a tick; a hundred times what was seen on fifteen bundled flights
# errors of single ticks change sign with the jerk: they add up like a random walk, of which ten
# sigma are allowed
DRIFT = 10.0


def check_orientation(run: RecordedRun) -> list[Finding]:
    """Check norm and sign of every quaternion, and the orientation as an integral.

    It is that of Omega, and of what the wheels alone make of Omega (Eq. 18, 20).
    """
    flight = run.flight
    found = []
    for place, q in (
        ("/vehicle q_nb", flight.vehicle_q_NB),
        ("/cue q_ws", flight.cue_q_WS),
        ("/motion q_ws", flight.motion_q_WS),
    ):
        found += exceeding(
            "norm",
            [place],
            flight.time,
            np.linalg.norm(q, axis=1) - 1.0,
            NORM,
            "",
            quantity="||q| - 1|",
        )
        found += _flips(place, flight.time, q)
    if len(flight.time) < 2:
        return found
    allowed = tick_error(run)
    left = unexplained(run, flight.motion_w_W, flight.motion_alpha_W)
    found += exceeding(
        "orientation is not the integral of Omega",
        ["/motion q_ws"],
        flight.time[1:],
        np.linalg.norm(left, axis=1),
        allowed,
        "rad",
        quantity="step",
    )
    return found + _wheel_drift(run, allowed)


def unexplained(run: RecordedRun, w_W: Array, alpha_W: Array) -> Array:
    """Rotation vectors (n - 1, 3), rad, W, of the part of each turn that the rate does not explain.

    w_W, alpha_W: rate (rad/s) and acceleration (rad/s^2) of the sphere at the ticks, (n, 3).

    The turn over a tick is the corrected trapezoid plus the Magnus commutator h^2/12 w1 x w0 of q'
    = 1/2 Omega o q.
    """
    q, h = run.flight.motion_q_WS, np.diff(run.flight.time)
    expected = turn(w_W, alpha_W, h) + (h * h / 12.0)[:, None] * cross(w_W[1:], w_W[:-1])
    return to_vector(product(product(q[1:], inverse(q[:-1])), inverse(from_vector(expected))))


def tick_error(run: RecordedRun) -> Array:
    """Bound (n - 1, 1), rad, on what rates and accelerations leave unexplained of each turn.

    It holds while the wheels keep their limit of jerk: their bound through J, and as much again of
    the commutator when the axis turns through the angle |Omega| h.
    """
    h = np.diff(run.flight.time)[:, None]
    jerk = np.linalg.norm(
        np.abs(run.sphere_from_wheels()) @ np.array(run.platform.wheel_limit_values().jerk)
    )
    rate = np.linalg.norm(run.flight.motion_w_W, axis=1)
    fastest = np.maximum(rate[:-1], rate[1:])[:, None]
    allowed: Array = TURN * jerk * np.abs(h) ** 3 * (1.0 + fastest * np.abs(h)) + ROUNDING
    return allowed


def _wheel_drift(run: RecordedRun, allowed: Array) -> list[Finding]:
    """Check the wheels alone, integrated from the first orientation on, against the logged one.

    To first order the difference is the sum of what each tick leaves unexplained, carried along
    with the cabin.
    """
    flight, to_sphere = run.flight, run.sphere_from_wheels().T
    left = unexplained(run, flight.wheel_speed @ to_sphere, flight.wheel_acceleration @ to_sphere)
    drift = np.cumsum(turned_back(flight.motion_q_WS[1:], left), axis=0)
    bound = DRIFT * np.sqrt(np.cumsum(allowed**2, axis=0))
    size = np.linalg.norm(np.where(np.isfinite(drift), drift, 0.0), axis=1)
    check, places = "orientation is not the integral of the wheels", ["/motion q_ws"]
    return exceeding(check, places, flight.time[1:], size, bound, "rad", quantity="drift")


def _flips(place: str, time: Array, q: Array) -> list[Finding]:
    """Find changes of sign.

    q and -q are one orientation, but viewers draw and interpolate a log that changes between them
    wrongly.
    """
    along = np.sum(q[:-1] * q[1:], axis=1)
    return exceeding(
        "sign flips", [place], time[1:], np.minimum(along, 0.0), 0.0, "", quantity="-q0.q1"
    )
