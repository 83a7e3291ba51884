"""Can the log be trusted? The wheels are derived from the motion again, and the orientation from the wheels alone."""

import numpy as np
from numpy.typing import ArrayLike

from .flight import Array, Flight
from .quaternions import accumulated, exp, geodesic
from .statistics import by_rows, largest


def consistency(flight: Flight, wheels_from_sphere: ArrayLike, sphere_from_wheels: ArrayLike) -> dict[str, float]:
    """How well the logged quantities agree with each other.

    - wheel_speed_mismatch_max_rad_s, wheel_acceleration_mismatch_max_rad_s2: logged against J^-1 times the logged motion;
    - orientation_drift_final_rad, orientation_drift_max_rad: `reintegrate` against the logged q_WS.

    The matrices are (3, 3): wheel speeds = wheels_from_sphere @ w_WS_W (J^-1, Eq. 22), and back (J, Eq. 18).
    """
    from_sphere = np.asarray(wheels_from_sphere, dtype=np.float64).T

    def mismatch(wheels: Array, sphere: Array) -> Array:
        """Logged wheels (n, 3) less J^-1 times the sphere's rate or acceleration (n, 3)."""
        return wheels - sphere @ from_sphere

    drift = by_rows(geodesic, reintegrate(flight, sphere_from_wheels), flight.motion_q_WS)
    return {
        "wheel_speed_mismatch_max_rad_s": largest(by_rows(mismatch, flight.wheel_speed, flight.motion_w_W)),
        "wheel_acceleration_mismatch_max_rad_s2": largest(by_rows(mismatch, flight.wheel_acceleration, flight.motion_alpha_W)),
        "orientation_drift_final_rad": float(drift[-1]) if len(drift) else 0.0,
        "orientation_drift_max_rad": largest(drift),
    }


def reintegrate(flight: Flight, sphere_from_wheels: ArrayLike) -> Array:
    """Orientations (n, 4) from the first one and the wheels alone, q' = 1/2 Omega o q with Omega = J omega (Eq. 18, 20).

    The turn over a tick is the integral of the cubic through the logged speeds and accelerations at its ends, plus the
    Magnus commutator of `rotation.integrate_base`: fourth order in the step.
    """
    if not len(flight.time):
        return np.empty((0, 4))
    to_sphere = np.asarray(sphere_from_wheels, dtype=np.float64).T

    def turns(h: Array, speed: Array, next_speed: Array, acceleration: Array, next_acceleration: Array) -> Array:
        """Quaternions (n, 4) of the turns over steps h (n,), s, from wheel speeds and accelerations (n, 3) at both ends."""
        w, next_w = speed @ to_sphere, next_speed @ to_sphere
        slowing = (acceleration - next_acceleration) @ to_sphere
        h = h[:, None]
        return exp(0.5 * h * (w + next_w) + h * h / 12.0 * (slowing + np.cross(next_w, w)))

    speed, acceleration = flight.wheel_speed, flight.wheel_acceleration
    each = by_rows(turns, np.diff(flight.time), speed[:-1], speed[1:], acceleration[:-1], acceleration[1:])
    return accumulated(flight.motion_q_WS[0], each)
