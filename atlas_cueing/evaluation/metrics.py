"""How good the cueing was, and what smoothing did to it."""

from math import tau

import numpy as np
from numpy.typing import NDArray

from ..rotation import conjugate, from_euler, to_euler
from ..signals import direction_error
from .flight import Array, Flight
from .quaternions import geodesic, multiply

_FLIP = np.array([1.0, 1.0, -1.0, -1.0])  # (N, FRD) quaternion to (W, FLU), see rotation.flip_rotation


def metrics(flight: Flight) -> dict[str, float]:
    """All figures of a flight, each with its unit in the name; shares are 0 to 1 of the ticks.

    - force, direction, rate: felt by the rider against felt by the pilot (specific force, its direction, angular rate);
    - attitude: cabin against vehicle, with the vehicle's heading at the start taken out;
    - cue_lag: motion against cue;
    - added_...: what smoothing adds to angular acceleration and stage acceleration while no limit is active (this tick and
      its neighbours), 0 where there is no such tick: chatter shows here;
    - turns: net turns of the cabin about its own axes, forward-right-down, with sign.

    A flight without ticks gives zeros.
    """
    return {
        "ticks": float(len(flight.time)),
        "duration_s": float(np.ptp(flight.time)) if len(flight.time) else 0.0,
        **_perception(flight),
        **_lag(flight),
        **_added(flight),
        **_effort(flight),
        **_turns(flight),
    }


def vehicle_attitude(flight: Flight) -> Array:
    """The vehicle's attitude as an orientation of the cabin, q_WS (n, 4), with its heading at the start taken out."""
    if not len(flight.time):
        return np.empty((0, 4))
    w, x, y, z = flight.vehicle_q_NB[0].tolist()
    heading = np.array(conjugate(from_euler(to_euler((w, x, y, z))[0], 0.0, 0.0)))
    attitude: Array = multiply(heading, flight.vehicle_q_NB) * _FLIP
    return attitude


def _perception(flight: Flight) -> dict[str, float]:
    force = _length(flight.felt_f - flight.vehicle_f_B)
    direction = direction_error(flight.vehicle_f_B, flight.felt_f)
    return {
        "force_rms_m_s2": _rms(force),
        "force_p95_m_s2": _p95(force),
        "force_max_m_s2": _max(force),
        "direction_rms_rad": _rms(direction),
        "direction_p95_rad": _p95(direction),
        "rate_rms_rad_s": _rms(_length(flight.felt_w - flight.vehicle_w_B)),
        "attitude_rms_rad": _rms(geodesic(vehicle_attitude(flight), flight.motion_q_WS)),
    }


def _lag(flight: Flight) -> dict[str, float]:
    angle = geodesic(flight.cue_q_WS, flight.motion_q_WS)
    distance = _length(flight.cue_p_W - flight.motion_p_W)
    return {
        "cue_lag_rms_rad": _rms(angle),
        "cue_lag_max_rad": _max(angle),
        "cue_lag_rms_m": _rms(distance),
        "cue_lag_max_m": _max(distance),
        "wheels_limited_share": _mean(flight.limited[:, 0]),
        "stage_limited_share": _mean(flight.limited[:, 1]),
    }


def _added(flight: Flight) -> dict[str, float]:
    """The added angular velocity is differenced, backwards; the added stage acceleration is in the log."""
    added_w = flight.motion_w_W - flight.cue_w_W
    added_alpha = np.diff(added_w, axis=0) / np.diff(flight.time)[:, None]
    added_a = flight.motion_a_W - flight.cue_a_W
    return {
        "added_angular_acceleration_rms_rad_s2": _rms(_length(added_alpha)[_free(flight.limited[:, 0])[1:]]),
        "added_stage_acceleration_rms_m_s2": _rms(_length(added_a)[_free(flight.limited[:, 1])]),
    }


def _effort(flight: Flight) -> dict[str, float]:
    return {
        "wheel_speed_max_rad_s": _max(flight.wheel_speed),
        "wheel_acceleration_max_rad_s2": _max(flight.wheel_acceleration),
        "stage_travel_max_m": _max(flight.motion_p_W),
        "stage_speed_max_m_s": _max(flight.motion_v_W),
        "stage_acceleration_max_m_s2": _max(flight.motion_a_W),
    }


def _turns(flight: Flight) -> dict[str, float]:
    names = ("roll", "pitch", "yaw")
    return {f"turns_{name}": float(np.trapezoid(flight.felt_w[:, i], flight.time)) / tau for i, name in enumerate(names)}


def _free(limited: Array) -> NDArray[np.bool_]:
    """Ticks (n,) at which no limit is active, nor at their neighbours."""
    active = np.concatenate([[0.0], limited, [0.0]]) != 0.0
    free: NDArray[np.bool_] = ~(active[:-2] | active[1:-1] | active[2:])
    return free


def _length(v: Array) -> Array:
    length: Array = np.linalg.norm(v, axis=1)
    return length


def _rms(x: Array) -> float:
    return float(np.sqrt(np.mean(x * x))) if len(x) else 0.0


def _mean(x: Array) -> float:
    return float(np.mean(x)) if len(x) else 0.0


def _p95(x: Array) -> float:
    return float(np.quantile(x, 0.95)) if len(x) else 0.0


def _max(x: Array) -> float:
    return float(np.max(np.abs(x), initial=0.0))
