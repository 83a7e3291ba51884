"""Figures of smoothing and actuators in closed form."""

import numpy as np
import pytest

from atlas_cueing.evaluation import gathered
from atlas_cueing.evaluation.actuation import Actuation
from atlas_cueing.rotation import exp, multiply

from .flights import column, sine, still

N = 1000


def test_lag_behind_the_cue() -> None:
    q_WS = np.tile(exp((0.3, 0.2, 0.1)), (N, 1))
    lagging = q_WS.copy()
    lagging[10] = multiply(exp((0.0, 0.05, 0.0)), exp((0.3, 0.2, 0.1)))
    behind = np.zeros((N, 3))
    behind[20] = (0.003, 0.004, 0.0)
    figures = gathered(
        Actuation(), still(N, cue_q_WS=q_WS, motion_q_WS=-lagging, motion_p_W=behind)
    )
    assert figures["cue_lag_max_rad"] == pytest.approx(0.05)
    assert figures["cue_lag_rms_rad"] == pytest.approx(0.05 / np.sqrt(N))
    assert figures["cue_lag_max_m"] == pytest.approx(0.005)
    assert figures["cue_lag_rms_m"] == pytest.approx(0.005 / np.sqrt(N))


def test_shares_of_limited_ticks() -> None:
    limited = np.zeros((N, 2))
    limited[:100, 0], limited[:250, 1] = 1.0, 1.0
    figures = gathered(Actuation(), still(N, limited=limited))
    assert (figures["wheels_limited_share"], figures["stage_limited_share"]) == (0.1, 0.25)


def test_chatter_that_smoothing_adds() -> None:
    """The rate flips by 0.002 rad/s every tick: 0.002 / 0.01 s = 0.2 rad/s^2."""
    flip = column(0.001 * (-1.0) ** np.arange(N), 2)
    cue = column(sine(N, 1.0, 5), 2)
    figures = gathered(Actuation(), still(N, cue_w_W=cue, motion_w_W=cue + flip))
    assert figures["added_angular_acceleration_rms_rad_s2"] == pytest.approx(0.2)
    assert (
        gathered(Actuation(), still(N, cue_w_W=cue, motion_w_W=cue))[
            "added_angular_acceleration_rms_rad_s2"
        ]
        == 0.0
    )


def test_chatter_of_a_long_flight_with_uneven_ticks() -> None:
    """More ticks than are computed at a time, against one difference of the whole."""
    random = np.random.default_rng(4)
    count = 40_000
    time = np.cumsum(random.uniform(0.005, 0.015, count))
    w, cue = random.normal(size=(2, count, 3))
    slope = np.diff(w - cue, axis=0) / np.diff(time)[:, None]
    figures = gathered(Actuation(), still(count, time=time, motion_w_W=w, cue_w_W=cue))
    expected = np.sqrt(np.mean(np.sum(slope**2, axis=1)))
    assert figures["added_angular_acceleration_rms_rad_s2"] == pytest.approx(expected, rel=1e-12)


def test_stage_acceleration_that_smoothing_adds() -> None:
    cue = column(sine(N, 1.0, 5), 0)
    figures = gathered(
        Actuation(), still(N, cue_a_W=cue, motion_a_W=cue + column(sine(N, 0.02, 50), 0))
    )
    assert figures["added_stage_acceleration_rms_m_s2"] == pytest.approx(0.02 / np.sqrt(2.0))


@pytest.mark.parametrize(
    ("active", "counted"), [(49, False), (50, False), (51, False), (48, True), (52, True)]
)
def test_ticks_beside_a_limit_are_not_counted_as_chatter(active: int, counted: bool) -> None:
    """A jump at tick 50 is what a limit does when it is active there or at a neighbour."""
    limited = np.zeros((N, 2))
    limited[active] = 1.0
    jump = np.zeros((N, 3))
    jump[50, 0] = 1.0
    figures = gathered(Actuation(), still(N, motion_a_W=jump, limited=limited))
    assert (figures["added_stage_acceleration_rms_m_s2"] > 0.0) == counted


@pytest.mark.parametrize(
    ("active", "counted"), [(49, False), (50, False), (51, False), (48, True), (52, True)]
)
def test_a_rate_step_beside_a_limit_is_not_counted_as_chatter(active: int, counted: bool) -> None:
    step = np.zeros((N, 3))
    step[50:, 0] = 1.0
    limited = np.zeros((N, 2))
    limited[active, 0] = 1.0
    figures = gathered(Actuation(), still(N, motion_w_W=step, limited=limited))
    assert (figures["added_angular_acceleration_rms_rad_s2"] > 0.0) == counted


def test_always_limited_adds_nothing() -> None:
    noise = np.random.default_rng(1).normal(size=(N, 3))
    figures = gathered(
        Actuation(), still(N, motion_w_W=noise, motion_a_W=noise, limited=np.ones((N, 2)))
    )
    assert (
        figures["added_angular_acceleration_rms_rad_s2"]
        == figures["added_stage_acceleration_rms_m_s2"]
        == 0.0
    )


def test_efforts_are_largest_magnitudes() -> None:
    values = np.zeros((N, 3))
    values[3, 1] = -7.0
    figures = gathered(
        Actuation(),
        still(
            N,
            wheel_speed=values,
            wheel_acceleration=2.0 * values,
            motion_p_W=0.1 * values,
            motion_v_W=0.2 * values,
            motion_a_W=0.3 * values,
        ),
    )
    assert (figures["wheel_speed_max_rad_s"], figures["wheel_acceleration_max_rad_s2"]) == (
        7.0,
        14.0,
    )
    assert figures["stage_travel_max_m"] == pytest.approx(0.7)
    assert figures["stage_speed_max_m_s"] == pytest.approx(1.4)
    assert figures["stage_acceleration_max_m_s2"] == pytest.approx(2.1)
