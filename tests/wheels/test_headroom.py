"""Headroom: at its rates some wheel is exactly at its limit, and nowhere beyond."""

import numpy as np
import pytest
from hypothesis import given

from atlas_cueing.rotation import Vec3, norm, scale
from atlas_cueing.signals import WheelLimits
from atlas_cueing.wheels import Geometry, headroom

from .geometries import SINGULAR, equilateral, geometries, geometry_of, vector

LIMITS = WheelLimits((31.0, 25.0, 40.0), (60.0, 70.0, 80.0), (600.0, 600.0, 600.0))


def use(geometry: Geometry, limit: Vec3, w_W: Vec3) -> float:
    return float(
        np.max(np.abs(np.array(geometry.wheels_from_sphere) @ np.array(w_W)) / np.array(limit))
    )


@given(geometries())
def test_a_wheel_is_at_its_limit_about_each_axis(geometry: Geometry) -> None:
    room = headroom(geometry, LIMITS)
    for axis, direction in enumerate(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))):
        assert use(geometry, LIMITS.speed, scale(room.rate[axis], direction)) == pytest.approx(
            1.0, rel=1e-12
        )
        assert use(
            geometry, LIMITS.acceleration, scale(room.acceleration[axis], direction)
        ) == pytest.approx(1.0, rel=1e-12)


@given(geometries(), vector)
def test_the_worst_axis_is_the_worst(geometry: Geometry, direction: Vec3) -> None:
    room = headroom(geometry, LIMITS)
    unit = scale(1.0 / norm(direction), direction)
    assert use(geometry, LIMITS.speed, scale(room.worst_rate, unit)) <= 1.0 + 1e-12
    assert use(geometry, LIMITS.acceleration, scale(room.worst_acceleration, unit)) <= 1.0 + 1e-12
    worst = max(
        use(geometry, LIMITS.speed, scale(room.worst_rate / norm(row), row))
        for row in geometry.wheels_from_sphere
    )
    assert worst == pytest.approx(1.0, rel=1e-12)


def test_paper_geometry_by_hand() -> None:
    """Section 4.2: the worst axis allows (r/R) w_max, and z sees only cos(theta).

    Rows are unit vectors.
    """
    limits = WheelLimits((31.0,) * 3, (60.0,) * 3, (600.0,) * 3)
    room = headroom(equilateral(np.radians(40.0)), limits)
    assert room.worst_rate == pytest.approx(0.08 / 0.75 * 31.0)
    assert room.rate[2] == pytest.approx(0.08 / 0.75 * 31.0 / np.cos(np.radians(40.0)))


def test_an_axis_that_turns_no_wheel_is_without_limit() -> None:
    flat = geometry_of(next(case for case in SINGULAR if "elevation 0" in case["name"]))
    room = headroom(flat, LIMITS)
    assert room.rate[:2] == (float("inf"), float("inf"))
    assert room.rate[2] < 10.0
