"""Errors of force, direction, rate and attitude on flights of known errors."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.evaluation import gathered
from atlas_cueing.evaluation.deviation import DIRECTION_FORCE, Deviation
from atlas_cueing.rotation import exp, flip_rotation, from_euler

from .flights import G, column, sine, still
from .references import vehicle_attitude

N = 1000
P95 = np.sin(0.95 * np.pi / 2.0)  # of the magnitude of a sine of amplitude 1
RMS = np.sqrt(0.5)


def test_force_error_of_a_sine() -> None:
    figures = gathered(Deviation(), still(N, felt_f=still(N).felt_f + column(sine(N, 2.0, 3), 1)))
    assert figures["force_rms_m_s2"] == pytest.approx(2.0 * RMS)
    assert figures["force_p95_m_s2"] == pytest.approx(2.0 * P95, rel=1e-3)
    assert figures["force_max_m_s2"] == pytest.approx(2.0, rel=1e-4)


def test_direction_error_of_a_tilted_cabin() -> None:
    angles = sine(N, 0.2, 4)
    felt = G * np.column_stack([np.sin(angles), np.zeros(N), -np.cos(angles)])
    figures = gathered(Deviation(), still(N, felt_f=felt))
    assert figures["direction_rms_rad"] == pytest.approx(0.2 * RMS)
    assert figures["direction_p95_rad"] == pytest.approx(0.2 * P95, rel=1e-3)
    assert figures["direction_max_rad"] == pytest.approx(0.2, rel=1e-4)
    assert figures["direction_counted_share"] == 1.0


@pytest.mark.parametrize("side", ["vehicle_f_B", "felt_f"])
def test_near_free_fall_there_is_no_direction(side: str) -> None:
    """A quarter of the flight at just under a tenth of g and upside down.

    Another quarter at just over it and sideways.
    """
    force = still(N).felt_f
    force[: N // 4] = (0.0, 0.0, 0.999 * DIRECTION_FORCE)
    force[N // 4 : N // 2] = (1.001 * DIRECTION_FORCE, 0.0, 0.0)
    figures = gathered(Deviation(), still(N, **{side: force}))
    assert figures["direction_counted_share"] == 0.75
    assert figures["direction_max_rad"] == pytest.approx(np.pi / 2.0)
    assert figures["direction_rms_rad"] == pytest.approx(np.pi / 2.0 / np.sqrt(3.0))


def test_free_fall_all_the_way() -> None:
    figures = gathered(Deviation(), still(N, vehicle_f_B=np.zeros(3)))
    assert (
        figures["direction_counted_share"]
        == figures["direction_rms_rad"]
        == figures["direction_max_rad"]
        == 0.0
    )
    assert figures["force_rms_m_s2"] == pytest.approx(G)


def test_rate_error() -> None:
    figures = gathered(
        Deviation(),
        still(N, vehicle_w_B=column(sine(N, 0.3, 2), 0), felt_w=column(sine(N, 0.3, 2), 1)),
    )
    assert figures["rate_rms_rad_s"] == pytest.approx(0.3)
    assert figures["rate_p95_rad_s"] == pytest.approx(0.3 * np.sqrt(2.0) * P95, rel=1e-3)
    assert figures["rate_max_rad_s"] == pytest.approx(0.3 * np.sqrt(2.0))


def test_the_heading_at_the_start_is_no_attitude_error() -> None:
    """Heading 2 rad, then a roll of 0.1 rad: W's x is the heading at the start."""
    q_NB = np.tile(from_euler(2.0, 0.0, 0.0), (N, 1))
    assert gathered(Deviation(), still(N, vehicle_q_NB=q_NB))["attitude_max_rad"] == pytest.approx(
        0.0, abs=1e-12
    )
    q_NB[N // 2 :] = from_euler(2.0, 0.0, 0.1)
    flight = still(N, vehicle_q_NB=q_NB)
    figures = gathered(Deviation(), flight)
    assert figures["attitude_rms_rad"] == pytest.approx(0.1 * RMS)
    assert figures["attitude_p95_rad"] == pytest.approx(0.1)
    assert figures["attitude_max_rad"] == pytest.approx(0.1)
    np.testing.assert_allclose(
        vehicle_attitude(flight)[-1], flip_rotation(from_euler(0.0, 0.0, 0.1)), atol=1e-15
    )
    assert (
        gathered(Deviation(), still(N, vehicle_q_NB=q_NB, motion_q_WS=vehicle_attitude(flight)))[
            "attitude_max_rad"
        ]
        < 1e-12
    )


def test_attitude_error_against_scipy_over_many_pieces() -> None:
    """Random attitudes of a long flight; heading and axes by scipy's rotations."""
    count = 40_000
    vehicle, cabin = (Rotation.random(count, rng=np.random.default_rng(k)) for k in (1, 2))
    heading = Rotation.from_euler("Z", vehicle[0].as_euler("ZYX")[0])
    flip = Rotation.from_euler("X", np.pi)
    wanted = (cabin.inv() * (flip * heading.inv() * vehicle * flip)).magnitude()
    quaternions = [r.as_quat(scalar_first=True) for r in (vehicle, cabin)]
    figures = gathered(
        Deviation(), still(count, vehicle_q_NB=quaternions[0], motion_q_WS=quaternions[1])
    )
    assert figures["attitude_rms_rad"] == pytest.approx(np.sqrt(np.mean(wanted**2)), rel=1e-12)
    assert figures["attitude_p95_rad"] == pytest.approx(np.quantile(wanted, 0.95), rel=1e-7)


def test_a_turn_to_the_right_is_negative_about_the_platforms_vertical() -> None:
    q_NB = np.array([from_euler(0.5, 0.0, 0.0), from_euler(0.6, 0.0, 0.0)])
    np.testing.assert_allclose(
        vehicle_attitude(still(2, vehicle_q_NB=q_NB))[1], exp((0.0, 0.0, -0.1)), atol=1e-15
    )


def test_extra_rate_is_counted_while_the_wheels_can_follow() -> None:
    """A slow turn of 0.05 rad/s, and a wheel limit that costs 1 rad/s for a tenth of it."""
    felt_w, limited = column(np.full(N, 0.05), 2), np.zeros((N, 2))
    felt_w[:100, 0], limited[:100, 0], limited[500:, 1] = 1.0, 1.0, 1.0
    figures = gathered(Deviation(), still(N, felt_w=felt_w, limited=limited))
    for statistic in ("rms", "p99", "max"):
        assert figures[f"extra_rate_{statistic}_rad_s"] == pytest.approx(0.05)
    always = gathered(Deviation(), still(N, felt_w=felt_w, limited=np.ones((N, 2))))
    assert always["extra_rate_max_rad_s"] == 0.0


def test_extra_rate_leaves_the_vehicles_out() -> None:
    w = np.random.default_rng(3).normal(size=(N, 3))
    figures = gathered(Deviation(), still(N, vehicle_w_B=w, felt_w=w + column(sine(N, 0.04, 1), 1)))
    assert figures["extra_rate_rms_rad_s"] == pytest.approx(0.04 * RMS)
    assert figures["extra_rate_p99_rad_s"] == pytest.approx(
        0.04 * np.sin(0.99 * np.pi / 2.0), rel=1e-3
    )
    assert figures["extra_rate_max_rad_s"] == pytest.approx(0.04, rel=1e-4)
