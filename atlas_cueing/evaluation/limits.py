"""Were the actuators' limits kept? By the logged values, and by finite differences of them."""

import numpy as np

from ..rotation import Vec3
from ..signals import StageLimits, WheelLimits
from .flight import Array, Flight

TOLERANCE = 1e-6  # of a limit: differences over 1 ms of times up to an hour carry rounding of 1e-9, resting on a limit is fair


def limit_use(flight: Flight, wheels: WheelLimits, stage: StageLimits) -> dict[str, float]:
    """Largest use of each limit over the flight and over wheels or axes, as a fraction of the limit.

    `..._logged` is the quantity in the log; `..._difference` the slope of the next lower one between two ticks, which the
    mean of the true quantity over the tick equals; `..._second_difference` the curvature of the speed over three ticks.
    """
    t = flight.time
    speed, acceleration = flight.wheel_speed, flight.wheel_acceleration
    p, v, a = flight.motion_p_W, flight.motion_v_W, flight.motion_a_W
    return {
        "wheel_speed_logged": _use(speed, wheels.speed),
        "wheel_acceleration_logged": _use(acceleration, wheels.acceleration),
        "wheel_acceleration_difference": _use(_slope(speed, t), wheels.acceleration),
        "wheel_jerk_difference": _use(_slope(acceleration, t), wheels.jerk),
        "wheel_jerk_second_difference": _use(_curvature(speed, t), wheels.jerk),
        "stage_travel_logged": _use(p, stage.travel),
        "stage_speed_logged": _use(v, stage.speed),
        "stage_speed_difference": _use(_slope(p, t), stage.speed),
        "stage_acceleration_logged": _use(a, stage.acceleration),
        "stage_acceleration_difference": _use(_slope(v, t), stage.acceleration),
        "stage_jerk_difference": _use(_slope(a, t), stage.jerk),
    }


def violations(use: dict[str, float], tolerance: float = TOLERANCE) -> list[str]:
    """One line for each limit that was exceeded, or that is not a number; empty when all were kept."""
    exceeded = {name: value for name, value in use.items() if not value <= 1.0 + tolerance}  # NaN too
    return [f"{name} = {value:.9g} of the limit, allowed: at most 1" for name, value in exceeded.items()]


def _use(values: Array, limit: Vec3) -> float:
    return float(np.max(np.abs(values) / np.array(limit), initial=0.0))


def _slope(values: Array, time: Array) -> Array:
    """Slope between ticks, (n - 1, 3)."""
    return np.diff(values, axis=0) / np.diff(time)[:, None]


def _curvature(values: Array, time: Array) -> Array:
    """Second divided difference times two, (n - 2, 3): the mean second derivative over three ticks, weighted by a hat."""
    span = 0.5 * (time[2:] - time[:-2])
    return np.diff(_slope(values, time), axis=0) / span[:, None]
