"""Figures on flights whose figures are known in closed form."""

import numpy as np
import pytest

from atlas_cueing.evaluation import metrics
from atlas_cueing.evaluation.metrics import vehicle_attitude
from atlas_cueing.rotation import exp, flip_rotation, from_euler, multiply

from .flights import G, sine, still

N = 1000


def column(values: np.ndarray, axis: int) -> np.ndarray:
    vector = np.zeros((len(values), 3))
    vector[:, axis] = values
    return vector


def test_a_perfect_flight_has_no_errors() -> None:
    figures = metrics(still(N))
    assert figures.pop("ticks") == N
    assert figures.pop("duration_s") == pytest.approx(9.99)
    assert set(figures.values()) == {0.0}


@pytest.mark.parametrize("count", [0, 1, 2])
def test_very_short_flights_have_figures_too(count: int) -> None:
    figures = metrics(still(count))
    assert figures["ticks"] == count
    assert all(np.isfinite(value) for value in figures.values())


def test_names_carry_units() -> None:
    units = ("_m_s2", "_rad", "_rad_s", "_rad_s2", "_m", "_m_s", "_s", "_share")
    counts = {"ticks", "turns_roll", "turns_pitch", "turns_yaw"}
    assert {name for name in metrics(still(3)) if not name.endswith(units)} == counts


def test_force_error_of_a_sine() -> None:
    felt = still(N).felt_f + column(sine(N, 2.0, 3), 1)
    figures = metrics(still(N, felt_f=felt))
    assert figures["force_rms_m_s2"] == pytest.approx(np.sqrt(2.0))
    assert figures["force_max_m_s2"] == pytest.approx(2.0, rel=1e-4)
    assert figures["force_p95_m_s2"] == pytest.approx(2.0 * np.sin(0.95 * np.pi / 2.0), rel=1e-3)


def test_direction_error_of_a_tilted_cabin() -> None:
    angles = sine(N, 0.2, 4)
    felt = G * np.column_stack([np.sin(angles), np.zeros(N), -np.cos(angles)])
    figures = metrics(still(N, felt_f=felt))
    assert figures["direction_rms_rad"] == pytest.approx(0.2 / np.sqrt(2.0))
    assert figures["direction_p95_rad"] == pytest.approx(0.2 * np.sin(0.95 * np.pi / 2.0), rel=1e-3)


def test_rate_error() -> None:
    figures = metrics(still(N, vehicle_w_B=column(sine(N, 0.3, 2), 0), felt_w=column(sine(N, 0.3, 2), 1)))
    assert figures["rate_rms_rad_s"] == pytest.approx(0.3)


def test_the_heading_at_the_start_is_no_attitude_error() -> None:
    """Heading 2 rad, then a roll of 0.1 rad: W's x is the heading at the start."""
    q_NB = np.tile(from_euler(2.0, 0.0, 0.0), (N, 1))
    assert metrics(still(N, vehicle_q_NB=q_NB))["attitude_rms_rad"] == pytest.approx(0.0, abs=1e-12)
    q_NB[N // 2 :] = from_euler(2.0, 0.0, 0.1)
    flight = still(N, vehicle_q_NB=q_NB)
    assert metrics(flight)["attitude_rms_rad"] == pytest.approx(0.1 / np.sqrt(2.0))
    np.testing.assert_allclose(vehicle_attitude(flight)[-1], flip_rotation(from_euler(0.0, 0.0, 0.1)), atol=1e-15)
    assert metrics(still(N, vehicle_q_NB=q_NB, motion_q_WS=vehicle_attitude(flight)))["attitude_rms_rad"] < 1e-12


def test_a_turn_to_the_right_is_negative_about_the_platforms_vertical() -> None:
    q_NB = np.array([from_euler(0.5, 0.0, 0.0), from_euler(0.6, 0.0, 0.0)])
    np.testing.assert_allclose(vehicle_attitude(still(2, vehicle_q_NB=q_NB))[1], exp((0.0, 0.0, -0.1)), atol=1e-15)


def test_lag_behind_the_cue() -> None:
    q_WS = np.tile(exp((0.3, 0.2, 0.1)), (N, 1))
    lagging = q_WS.copy()
    lagging[10] = multiply(exp((0.0, 0.05, 0.0)), exp((0.3, 0.2, 0.1)))
    behind = np.zeros((N, 3))
    behind[20] = (0.003, 0.004, 0.0)
    figures = metrics(still(N, cue_q_WS=q_WS, motion_q_WS=-lagging, motion_p_W=behind))
    assert figures["cue_lag_max_rad"] == pytest.approx(0.05)
    assert figures["cue_lag_rms_rad"] == pytest.approx(0.05 / np.sqrt(N))
    assert figures["cue_lag_max_m"] == pytest.approx(0.005)
    assert figures["cue_lag_rms_m"] == pytest.approx(0.005 / np.sqrt(N))


def test_shares_of_limited_ticks() -> None:
    limited = np.zeros((N, 2))
    limited[:100, 0], limited[:250, 1] = 1.0, 1.0
    figures = metrics(still(N, limited=limited))
    assert (figures["wheels_limited_share"], figures["stage_limited_share"]) == (0.1, 0.25)


def test_chatter_that_smoothing_adds() -> None:
    """The rate flips by 2 mm/s... of an angle every tick: 0.002 / 0.01 s = 0.2 rad/s^2."""
    flip = column(0.001 * (-1.0) ** np.arange(N), 2)
    cue = column(sine(N, 1.0, 5), 2)
    figures = metrics(still(N, cue_w_W=cue, motion_w_W=cue + flip))
    assert figures["added_angular_acceleration_rms_rad_s2"] == pytest.approx(0.2)
    assert metrics(still(N, cue_w_W=cue, motion_w_W=cue))["added_angular_acceleration_rms_rad_s2"] == 0.0


def test_stage_acceleration_that_smoothing_adds() -> None:
    cue = column(sine(N, 1.0, 5), 0)
    figures = metrics(still(N, cue_a_W=cue, motion_a_W=cue + column(sine(N, 0.02, 50), 0)))
    assert figures["added_stage_acceleration_rms_m_s2"] == pytest.approx(0.02 / np.sqrt(2.0))


@pytest.mark.parametrize(("active", "counted"), [(49, False), (50, False), (51, False), (48, True), (52, True)])
def test_ticks_beside_a_limit_are_not_counted_as_chatter(active: int, counted: bool) -> None:
    """A jump at tick 50 is what a limit does when it is active there or at a neighbour."""
    limited = np.zeros((N, 2))
    limited[active] = 1.0
    jump = np.zeros((N, 3))
    jump[50, 0] = 1.0
    figures = metrics(still(N, motion_a_W=jump, limited=limited))
    assert (figures["added_stage_acceleration_rms_m_s2"] > 0.0) == counted


@pytest.mark.parametrize(("active", "counted"), [(49, False), (50, False), (51, False), (48, True), (52, True)])
def test_a_rate_step_beside_a_limit_is_not_counted_as_chatter(active: int, counted: bool) -> None:
    step = np.zeros((N, 3))
    step[50:, 0] = 1.0
    limited = np.zeros((N, 2))
    limited[active, 0] = 1.0
    figures = metrics(still(N, motion_w_W=step, limited=limited))
    assert (figures["added_angular_acceleration_rms_rad_s2"] > 0.0) == counted


def test_always_limited_adds_nothing() -> None:
    noise = np.random.default_rng(1).normal(size=(N, 3))
    figures = metrics(still(N, motion_w_W=noise, motion_a_W=noise, limited=np.ones((N, 2))))
    assert figures["added_angular_acceleration_rms_rad_s2"] == figures["added_stage_acceleration_rms_m_s2"] == 0.0


def test_turns_are_net_and_about_the_cabins_axes() -> None:
    time = np.arange(1001) * 0.01
    roll = 2.0 * np.pi * 3.5 / 10.0 * np.ones(1001)
    felt_w = np.column_stack([roll, -0.5 * roll, np.sin(2.0 * np.pi * time / 10.0)])
    figures = metrics(still(1001, felt_w=felt_w))
    assert figures["turns_roll"] == pytest.approx(3.5)
    assert figures["turns_pitch"] == pytest.approx(-1.75)
    assert figures["turns_yaw"] == pytest.approx(0.0, abs=1e-9)


def test_efforts_are_largest_magnitudes() -> None:
    values = np.zeros((N, 3))
    values[3, 1] = -7.0
    figures = metrics(
        still(
            N,
            wheel_speed=values,
            wheel_acceleration=2.0 * values,
            motion_p_W=0.1 * values,
            motion_v_W=0.2 * values,
            motion_a_W=0.3 * values,
        )
    )
    assert (figures["wheel_speed_max_rad_s"], figures["wheel_acceleration_max_rad_s2"]) == (7.0, 14.0)
    assert figures["stage_travel_max_m"] == pytest.approx(0.7)
    assert figures["stage_speed_max_m_s"] == pytest.approx(1.4)
    assert figures["stage_acceleration_max_m_s2"] == pytest.approx(2.1)
