"""Limits and chains of integrals on a motion known in closed form."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.review.checks.actuators import check_actuators, limit_shares

from ..runs import coning, with_flight


@pytest.mark.parametrize("platform", ["atlas-2.9m", "atlas-orthogonal"])
@pytest.mark.parametrize("dt", [0.001, 0.01, 0.05])
def test_a_true_motion_is_clean(dt: float, platform: str) -> None:
    assert check_actuators(coning(201, dt, platform)) == []


def test_review_has_the_platforms_matrices() -> None:
    """Its own arithmetic and the project's agree."""
    run = coning(2)
    geometry = run.platform.geometry()
    assert run.wheels_from_sphere() == pytest.approx(
        np.array(geometry.wheels_from_sphere), rel=1e-14
    )
    assert run.sphere_from_wheels() == pytest.approx(
        np.array(geometry.sphere_from_wheels), rel=1e-13
    )


def test_shares() -> None:
    run = coning()
    shares = limit_shares(run)
    wheels, stage = (
        ["wheel_speed", "wheel_acceleration", "wheel_jerk"],
        [
            "stage_speed",
            "stage_acceleration",
            "stage_jerk",
        ],
    )
    assert list(shares) == [*wheels, "stage_travel", *stage]
    assert shares["wheel_speed"] * 31.0 == pytest.approx(run.flight.wheel_speed)
    assert shares["stage_travel"][:, 2] == pytest.approx(0.0)
    t = run.flight.time[:-1] + 0.005
    assert shares["stage_jerk"][:, 0] * 60.0 == pytest.approx(
        -0.2 * np.cos(t) + 0.8 * np.cos(2 * t), abs=1e-4
    )


@pytest.mark.parametrize(
    ("field", "amount", "check", "place"),
    [
        ("motion_p_W", 1e-4, "not the integral of its speed", "/motion px_m"),
        ("motion_v_W", 0.02, "not the integral of its acceleration", "/motion vx_m_s"),
        ("wheel_speed", 0.05, "not the integral of its acceleration", "/wheels w1_rad_s"),
        ("wheel_speed", 1e-8, "not J^-1 of the motion", "/wheels w1_rad_s"),
        ("wheel_acceleration", 1e-8, "not J^-1 of the motion", "/wheels a1_rad_s2"),
        ("motion_a_W", 20.0, "limit", "/motion ax_m_s2"),
        ("motion_p_W", 5.0, "limit", "/motion px_m"),
        ("motion_p_W", 5.0, "limit", "/motion px_m by differences"),
        ("motion_v_W", 0.08, "limit", "/motion vx_m_s by differences"),
        ("motion_v_W", 0.03, "limit", "/motion vx_m_s by second differences"),
        ("motion_a_W", 0.7, "limit", "/motion ax_m_s2 by differences"),
        ("wheel_speed", 0.7, "limit", "/wheels w1_rad_s by differences"),
        ("wheel_speed", 0.2, "limit", "/wheels w1_rad_s by second differences"),
        ("wheel_acceleration", 7.0, "limit", "/wheels a1_rad_s2 by differences"),
    ],
)
def test_a_step_of_one_column(field: str, amount: float, check: str, place: str) -> None:
    """From the tick 300 on, the first component is larger."""
    run = coning()
    values = getattr(run.flight, field).copy()
    values[300:, 0] += amount
    found = check_actuators(with_flight(run, replace(run.flight, **{field: values})))
    (matching,) = [finding for finding in found if (finding.check, finding.place) == (check, place)]
    assert matching.time is not None
    assert 2.99 <= matching.time <= 6.0


@pytest.mark.parametrize("count", [0, 1, 2])
def test_few_ticks(count: int) -> None:
    assert check_actuators(coning(count)) == []
