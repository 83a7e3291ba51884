"""Wheels and orientation derived again from a flight whose motion is known."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from atlas_cueing.evaluation import Consistency, RunColumns, gathered
from atlas_cueing.rotation import exp, multiply

from .flights import still

TO_WHEELS = np.array([[7.0, -2.0, 1.0], [0.5, 6.0, -3.0], [-1.0, 2.0, 8.0]])
TO_SPHERE = np.linalg.inv(TO_WHEELS)


def consistency(flight: RunColumns) -> dict[str, float]:
    return gathered(Consistency(TO_WHEELS, TO_SPHERE), flight)


def rate(t: np.ndarray | float) -> np.ndarray:
    return np.stack([1.5 * np.sin(t), 1.2 * np.cos(0.7 * t), 0.8 + 0.4 * np.sin(2.0 * t)], axis=-1)


def acceleration(t: np.ndarray) -> np.ndarray:
    return np.stack([1.5 * np.cos(t), -0.84 * np.sin(0.7 * t), 0.8 * np.cos(2.0 * t)], axis=-1)


def tumbling(rate_hz: float, duration: float = 10.0) -> RunColumns:
    """A flight on `rate`, with orientations by scipy's integrator on q' = 1/2 w_W o q."""
    t = np.arange(int(duration * rate_hz) + 1) / rate_hz
    start = np.array(exp((0.4, -0.2, 0.9)))

    def spin(s: float, q: np.ndarray) -> np.ndarray:
        return 0.5 * np.array(multiply((0.0, *rate(s)), tuple(q)))

    solved = solve_ivp(spin, (0.0, t[-1]), start, method="DOP853", t_eval=t, rtol=1e-12, atol=1e-13)
    w, alpha = rate(t), acceleration(t)
    return still(
        len(t),
        time=t,
        motion_q_WS=solved.y.T,
        motion_w_W=w,
        motion_alpha_W=alpha,
        wheel_speed=w @ TO_WHEELS.T,
        wheel_acceleration=alpha @ TO_WHEELS.T,
    )


def test_a_true_flight_is_consistent() -> None:
    found = consistency(tumbling(100.0))
    assert found["wheel_speed_residual_max_rad_s"] == 0.0
    assert found["wheel_acceleration_residual_max_rad_s2"] == 0.0
    assert found["orientation_drift_max_rad"] < 1e-8
    assert found["orientation_drift_final_rad"] <= found["orientation_drift_max_rad"]


def test_reintegration_is_of_fourth_order() -> None:
    drifts = [consistency(tumbling(hz))["orientation_drift_max_rad"] for hz in (10.0, 20.0)]
    assert 12.0 < drifts[0] / drifts[1] < 20.0


def test_drift_is_seen_where_it_is() -> None:
    flight = tumbling(100.0)
    q = flight.motion_q_WS.copy()
    q[500] = multiply(exp((0.0, 0.0, 0.02)), tuple(q[500]))
    found = consistency(replace(flight, motion_q_WS=q))
    assert found["orientation_drift_max_rad"] == pytest.approx(0.02, abs=1e-6)
    assert found["orientation_drift_final_rad"] < 1e-6


def test_wheels_that_do_not_belong_to_the_motion_are_seen() -> None:
    flight = tumbling(100.0)
    speed, acceleration = flight.wheel_speed.copy(), flight.wheel_acceleration.copy()
    speed[7, 1] += 0.25
    acceleration[9, 2] -= 0.5
    found = consistency(replace(flight, wheel_speed=speed, wheel_acceleration=acceleration))
    assert found["wheel_speed_residual_max_rad_s"] == pytest.approx(0.25)
    assert found["wheel_acceleration_residual_max_rad_s2"] == pytest.approx(0.5)


def test_the_rate_in_cabin_axes_does_not_pass() -> None:
    """The classic mix-up: wheels driven by the body rate instead of the rate in W."""
    flight = tumbling(100.0)
    body = np.array(
        [multiply(multiply((q[0], -q[1], -q[2], -q[3]), (0.0, *w)), q)[1:] for q, w in rows(flight)]
    )
    found = consistency(replace(flight, wheel_speed=body @ TO_WHEELS.T))
    assert found["wheel_speed_residual_max_rad_s"] > 1.0
    assert found["orientation_drift_max_rad"] > 0.1


def rows(flight: RunColumns) -> list[tuple[tuple[float, ...], tuple[float, ...]]]:
    return [
        (tuple(q), tuple(w))
        for q, w in zip(flight.motion_q_WS.tolist(), flight.motion_w_W.tolist(), strict=True)
    ]


@pytest.mark.parametrize("count", [0, 1, 2])
def test_very_short_flights(count: int) -> None:
    assert set(consistency(still(count)).values()) == {0.0}
