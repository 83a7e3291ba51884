"""What smoothing did to the cue, and what the actuators had to do."""

import numpy as np
from numpy.typing import NDArray

from .flight import Array, Flight
from .quaternions import geodesic
from .statistics import by_rows, largest, length, mean, rms


def effort(flight: Flight) -> dict[str, float]:
    """Figures of smoothing and of the actuators.

    - cue_lag: motion against cue;
    - wheels_limited_share, stage_limited_share: ticks at which smoothing could not give what was asked;
    - added_...: what smoothing adds to angular acceleration and stage acceleration while no limit is active (this tick and
      its neighbours), 0 where there is no such tick: chatter shows here. The added angular velocity is differenced,
      backwards; the added stage acceleration is in the log;
    - wheel_..., stage_...: largest magnitudes.
    """
    return {**_lag(flight), **_added(flight), **_largest(flight)}


def _lag(flight: Flight) -> dict[str, float]:
    angle = by_rows(geodesic, flight.cue_q_WS, flight.motion_q_WS)
    distance = by_rows(_distance, flight.cue_p_W, flight.motion_p_W)
    return {
        "cue_lag_rms_rad": rms(angle),
        "cue_lag_max_rad": largest(angle),
        "cue_lag_rms_m": rms(distance),
        "cue_lag_max_m": largest(distance),
        "wheels_limited_share": mean(flight.limited[:, 0]),
        "stage_limited_share": mean(flight.limited[:, 1]),
    }


def _added(flight: Flight) -> dict[str, float]:
    w, cue_w = flight.motion_w_W, flight.cue_w_W
    added_dw = by_rows(_change, w[1:], w[:-1], cue_w[1:], cue_w[:-1])
    added_alpha = added_dw / np.diff(flight.time)
    added_a = by_rows(_distance, flight.motion_a_W, flight.cue_a_W)
    return {
        "added_angular_acceleration_rms_rad_s2": rms(added_alpha[_free(flight.limited[:, 0])[1:]]),
        "added_stage_acceleration_rms_m_s2": rms(added_a[_free(flight.limited[:, 1])]),
    }


def _largest(flight: Flight) -> dict[str, float]:
    return {
        "wheel_speed_max_rad_s": largest(flight.wheel_speed),
        "wheel_acceleration_max_rad_s2": largest(flight.wheel_acceleration),
        "stage_travel_max_m": largest(flight.motion_p_W),
        "stage_speed_max_m_s": largest(flight.motion_v_W),
        "stage_acceleration_max_m_s2": largest(flight.motion_a_W),
    }


def _distance(p: Array, q: Array) -> Array:
    return length(p - q)


def _change(w: Array, w_before: Array, cue: Array, cue_before: Array) -> Array:
    return length((w - cue) - (w_before - cue_before))


def _free(limited: Array) -> NDArray[np.bool_]:
    """Ticks (n,) at which no limit is active, nor at their neighbours."""
    active = np.concatenate([[0.0], limited, [0.0]]) != 0.0
    free: NDArray[np.bool_] = ~(active[:-2] | active[1:-1] | active[2:])
    return free
