"""How far the rider's motion is from the pilot's, tick by tick."""

import numpy as np

from ..rotation import conjugate, from_euler, to_euler
from ..signals import STANDARD_GRAVITY, direction_error
from .flight import Array, Flight
from .quaternions import geodesic, multiply
from .statistics import by_rows, largest, length, mean, quantile, rms, spread

DIRECTION_FORCE = 0.1 * STANDARD_GRAVITY
"""Specific force that has a direction worth comparing, m/s^2 (assumed): at a tenth of g the smallest sideways force that is
felt, 0.17 m/s^2 (`cues.FORCE_THRESHOLD`), already turns it by 10 deg."""

_FLIP = np.array([1.0, 1.0, -1.0, -1.0])  # (N, FRD) quaternion to (W, FLU), see rotation.flip_rotation


def deviation(flight: Flight) -> dict[str, float]:
    """Rms, 95 % quantile and maximum over the flight of what the rider has against what the pilot has.

    - force_..._m_s2: length of the difference of the specific forces at the head, felt - vehicle, cabin FRD;
    - direction_..._rad: angle between them, over the ticks at which both are larger than `DIRECTION_FORCE` (near free fall a
      force has no direction to speak of); direction_counted_share is the share of those ticks;
    - rate_..._rad_s: length of the difference of the angular rates, felt - vehicle, cabin FRD;
    - attitude_..._rad: angle of the rotation from the vehicle's attitude (`vehicle_attitude`) to the cabin's.
    """
    direction = by_rows(_direction, flight.vehicle_f_B, flight.felt_f)
    counted = ~np.isnan(direction)
    return {
        **spread("force", "m_s2", by_rows(_distance, flight.felt_f, flight.vehicle_f_B)),
        **spread("direction", "rad", direction[counted]),
        "direction_counted_share": mean(counted.astype(np.float64)),
        **spread("rate", "rad_s", by_rows(_distance, flight.felt_w, flight.vehicle_w_B)),
        **spread("attitude", "rad", _attitude(flight)),
    }


def extra_rate(flight: Flight) -> dict[str, float]:
    """Cabin rate beyond the vehicle's, |felt - vehicle|, over the ticks at which the wheels are not limited.

    extra_rate_rms_rad_s, extra_rate_p99_rad_s, extra_rate_max_rad_s: what the cueing turns the rider on its own account, with
    what the actuators could not give left out; the same difference over all ticks is the rate error of `deviation`.
    """
    extra = by_rows(_distance, flight.felt_w, flight.vehicle_w_B)[flight.limited[:, 0] == 0.0]
    return {
        "extra_rate_rms_rad_s": rms(extra),
        "extra_rate_p99_rad_s": quantile(extra, 0.99),
        "extra_rate_max_rad_s": largest(extra),
    }


def vehicle_attitude(flight: Flight) -> Array:
    """The vehicle's attitude as an orientation of the cabin, q_WS (n, 4), with its heading at the start taken out."""
    return _cabin(flight.vehicle_q_NB, flight.vehicle_q_NB)


def _attitude(flight: Flight) -> Array:
    start = flight.vehicle_q_NB[:1]
    return by_rows(lambda q_NB, q_WS: geodesic(_cabin(q_NB, start), q_WS), flight.vehicle_q_NB, flight.motion_q_WS)


def _cabin(q_NB: Array, start: Array) -> Array:
    """Cabin orientations for vehicle attitudes, heading at the start being that of the first row of `start`."""
    if not len(start):
        return np.empty((0, 4))
    w, x, y, z = start[0].tolist()
    heading = np.array(conjugate(from_euler(to_euler((w, x, y, z))[0], 0.0, 0.0)))
    attitude: Array = multiply(heading, q_NB) * _FLIP
    return attitude


def _distance(p: Array, q: Array) -> Array:
    return length(p - q)


def _direction(f: Array, g: Array) -> Array:
    """Angles (rad), NaN where one of the forces is too small to have a direction."""
    small = (length(f) <= DIRECTION_FORCE) | (length(g) <= DIRECTION_FORCE)
    return np.where(small, np.nan, direction_error(f, g))
