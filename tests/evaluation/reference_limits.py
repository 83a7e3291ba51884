"""Use of the limits, and the orientation from the wheels, again from the columns of a whole run.

By numpy and scipy; nothing is shared with the classes that compute them in blocks but the names.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation

from atlas_cueing.evaluation import RunColumns
from atlas_cueing.signals import StageLimits, WheelLimits

from .references import Figures, rotations


def limit_use(flight: RunColumns, wheels: WheelLimits, stage: StageLimits) -> Figures:
    t = flight.time
    speed = flight.wheel_speed
    # the second divided difference of three ticks, from the parabola through them
    curvature = [
        2.0 * np.polyfit(t[k : k + 3] - t[k], speed[k : k + 3], 2)[0] for k in range(len(t) - 2)
    ]
    used = {
        "wheel_speed_logged": (speed, wheels.speed),
        "wheel_acceleration_logged": (flight.wheel_acceleration, wheels.acceleration),
        "wheel_acceleration_difference": (slope(t, speed), wheels.acceleration),
        "wheel_jerk_difference": (slope(t, flight.wheel_acceleration), wheels.jerk),
        "wheel_jerk_second_difference": (np.array(curvature), wheels.jerk),
        "stage_travel_logged": (flight.motion_p_W, stage.travel),
        "stage_speed_logged": (flight.motion_v_W, stage.speed),
        "stage_speed_difference": (slope(t, flight.motion_p_W), stage.speed),
        "stage_acceleration_logged": (flight.motion_a_W, stage.acceleration),
        "stage_acceleration_difference": (slope(t, flight.motion_v_W), stage.acceleration),
        "stage_jerk_difference": (slope(t, flight.motion_a_W), stage.jerk),
    }
    return {name: float(np.max(np.abs(v) / np.array(limit))) for name, (v, limit) in used.items()}


def slope(t: np.ndarray, x: np.ndarray) -> np.ndarray:
    return np.array([(x[k + 1] - x[k]) / (t[k + 1] - t[k]) for k in range(len(t) - 1)])


def reintegrate(flight: RunColumns, sphere_from_wheels: np.ndarray) -> Rotation:
    """Orientations from the first one and the wheels alone, by scipy's integrator.

    Between ticks the rate is the cubic through the logged speeds and accelerations at its ends.
    """
    rate = CubicHermiteSpline(
        flight.time,
        flight.wheel_speed @ sphere_from_wheels.T,
        flight.wheel_acceleration @ sphere_from_wheels.T,
    )

    def spin(t: float, q: np.ndarray) -> np.ndarray:
        w, (s, v) = rate(t), (q[0], q[1:])
        return 0.5 * np.concatenate([[-w @ v], s * w + np.cross(w, v)])

    solved = solve_ivp(
        spin,
        (flight.time[0], flight.time[-1]),
        flight.motion_q_WS[0],
        method="DOP853",
        t_eval=flight.time,
        rtol=1e-11,
        atol=1e-12,
    )
    return rotations(solved.y.T)


def consistency(flight: RunColumns, sphere_from_wheels: np.ndarray) -> Figures:
    speed = np.linalg.solve(sphere_from_wheels, flight.motion_w_W.T).T
    acceleration = np.linalg.solve(sphere_from_wheels, flight.motion_alpha_W.T).T
    drift = reintegrate(flight, sphere_from_wheels) * rotations(flight.motion_q_WS).inv()
    return {
        "wheel_speed_residual_max_rad_s": float(np.max(np.abs(flight.wheel_speed - speed))),
        "wheel_acceleration_residual_max_rad_s2": float(
            np.max(np.abs(flight.wheel_acceleration - acceleration))
        ),
        "orientation_drift_final_rad": float(drift.magnitude()[-1]),
        "orientation_drift_max_rad": float(np.max(drift.magnitude())),
    }
