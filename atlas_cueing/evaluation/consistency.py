"""Can the log be trusted? The wheels are derived from the motion again, and the orientation from the wheels alone."""

from itertools import accumulate

import numpy as np
from numpy.typing import ArrayLike

from ..rotation import Quat, multiply
from .flight import Array, Flight
from .quaternions import exp, geodesic


def consistency(flight: Flight, wheels_from_sphere: ArrayLike, sphere_from_wheels: ArrayLike) -> dict[str, float]:
    """How well the logged quantities agree with each other.

    - wheel_speed_mismatch_max_rad_s, wheel_acceleration_mismatch_max_rad_s2: logged against J^-1 times the logged motion;
    - orientation_drift_final_rad, orientation_drift_max_rad: `reintegrate` against the logged q_WS.

    The matrices are (3, 3): wheel speeds = wheels_from_sphere @ w_WS_W (J^-1, Eq. 22), and back (J, Eq. 18).
    """
    from_sphere = np.asarray(wheels_from_sphere, dtype=np.float64).T
    drift = geodesic(reintegrate(flight, sphere_from_wheels), flight.motion_q_WS)
    return {
        "wheel_speed_mismatch_max_rad_s": _max(flight.wheel_speed - flight.motion_w_W @ from_sphere),
        "wheel_acceleration_mismatch_max_rad_s2": _max(flight.wheel_acceleration - flight.motion_alpha_W @ from_sphere),
        "orientation_drift_final_rad": float(drift[-1]) if len(drift) else 0.0,
        "orientation_drift_max_rad": _max(drift),
    }


def reintegrate(flight: Flight, sphere_from_wheels: ArrayLike) -> Array:
    """Orientations (n, 4) from the first one and the wheels alone, q' = 1/2 Omega o q with Omega = J omega (Eq. 18, 20).

    The turn over a tick is the integral of the cubic through the logged speeds and accelerations at its ends, plus the
    Magnus commutator of `rotation.integrate_base`: fourth order in the step.
    """
    if not len(flight.time):
        return np.empty((0, 4))
    to_sphere = np.asarray(sphere_from_wheels, dtype=np.float64).T
    h = np.diff(flight.time)[:, None]
    w, alpha = flight.wheel_speed @ to_sphere, flight.wheel_acceleration @ to_sphere
    turns = 0.5 * h * (w[:-1] + w[1:]) + h * h / 12.0 * (alpha[:-1] - alpha[1:] + np.cross(w[1:], w[:-1]))
    return np.array(list(accumulate(map(_quat, exp(turns)), _after, initial=_quat(flight.motion_q_WS[0]))))


def _quat(row: Array) -> Quat:
    w, x, y, z = row.tolist()
    return (w, x, y, z)


def _after(q: Quat, turn: Quat) -> Quat:
    return multiply(turn, q)


def _max(x: Array) -> float:
    return float(np.max(np.abs(x), initial=0.0))
