"""Wheel speeds of a motion: back through the Jacobian, and by finite differences.

The latter are of an orientation turned by the wheels alone.
"""

from math import cos, sin

import numpy as np
import pytest
from hypothesis import given

from atlas_cueing.errors import SlipConditionError
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Vec3,
    apply,
    conjugate,
    integrate_base,
    log,
    multiply,
    scale,
)
from atlas_cueing.signals import Motion
from atlas_cueing.wheels import Geometry, Wheels

from .geometries import SINGULAR, equilateral, geometries, geometry_of, vector

WHEELS = Wheels(equilateral(0.7))


def motion(time: float, w_WS_W: Vec3, alpha_WS_W: Vec3) -> Motion:
    return Motion(time, IDENTITY, w_WS_W, alpha_WS_W, ZERO, ZERO, ZERO, (0.0, 0.0))


@given(geometries(), vector, vector)
def test_speeds_bring_the_motion_back_through_the_jacobian(
    geometry: Geometry, w_W: Vec3, alpha_W: Vec3
) -> None:
    wheels = Wheels(geometry)
    speeds = wheels.speeds(motion(1.5, w_W, alpha_W))
    assert speeds.time == 1.5
    np.testing.assert_allclose(apply(geometry.sphere_from_wheels, speeds.speed), w_W, atol=1e-9)
    np.testing.assert_allclose(
        apply(geometry.sphere_from_wheels, speeds.acceleration), alpha_W, atol=1e-9
    )


def test_finite_differences_of_the_orientation_turned_by_the_wheels() -> None:
    """Wheel speeds -> J -> Eq. 20 integrated -> central difference of q gives the rate.

    It is in the BASE frame.
    """

    def rate(t: float) -> Vec3:
        return (1.1 * cos(2.0 * t), 0.8 * sin(1.3 * t) + 0.2, -0.9 * cos(0.7 * t))

    dt, q = 1e-3, IDENTITY
    path = [q]
    for tick in range(400):
        w0, middle, w1 = (
            apply(WHEELS.sphere_from_wheels, WHEELS.speeds(motion(t, rate(t), ZERO)).speed)
            for t in (tick * dt, (tick + 0.5) * dt, (tick + 1.0) * dt)
        )
        turn = (
            dt * (w0[0] + 4.0 * middle[0] + w1[0]) / 6.0,
            dt * (w0[1] + 4.0 * middle[1] + w1[1]) / 6.0,
            dt * (w0[2] + 4.0 * middle[2] + w1[2]) / 6.0,
        )
        q = integrate_base(q, turn, w0, w1, dt)
        path.append(q)
    for tick in range(1, 400):
        difference = scale(0.5 / dt, log(multiply(path[tick + 1], conjugate(path[tick - 1]))))
        np.testing.assert_allclose(difference, rate(tick * dt), atol=3e-6)
    assert log(path[-1])[0] > 0.1  # it did turn


def test_acceleration_is_the_derivative_of_speed() -> None:
    def moving(t: float) -> Motion:
        return motion(t, (sin(t), cos(2.0 * t), t), (cos(t), -2.0 * sin(2.0 * t), 1.0))

    h = 1e-5
    before, now, after = (WHEELS.speeds(moving(0.4 + k * h)) for k in (-1, 0, 1))
    difference = (np.array(after.speed) - np.array(before.speed)) / (2.0 * h)
    np.testing.assert_allclose(now.acceleration, difference, rtol=1e-8)


@pytest.mark.parametrize("case", SINGULAR, ids=lambda case: case["name"])
def test_no_drive_for_a_singular_geometry(case: dict) -> None:
    with pytest.raises(SlipConditionError):
        Wheels(geometry_of(case))
