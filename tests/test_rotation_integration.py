"""Rates integrated to orientations, against a fine integration."""

from math import cos, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from rotation_cases import direction, quaternion, scipy
from scipy.spatial.transform import Rotation

from atlas_cueing import rotation as rot
from atlas_cueing.rotation import Quat, Vec3
from atlas_cueing.rotations import Array


def rate(t: float) -> Vec3:
    return (1.3 * cos(2.1 * t), 0.9 * sin(1.7 * t) + 0.4, -1.1 * cos(0.8 * t + 0.3))


def rate_integral(t: float) -> Vec3:
    return (
        1.3 / 2.1 * sin(2.1 * t),
        -0.9 / 1.7 * cos(1.7 * t) + 0.4 * t,
        -1.1 / 0.8 * sin(0.8 * t + 0.3),
    )


def quaternion_rate(frame: str, t: float, q: Array) -> Array:
    """q' = 1/2 w q in the base frame, 1/2 q w in the body frame, written as matrices."""
    x, y, z = rate(t)
    s = 1.0 if frame == "base" else -1.0
    m = np.array(
        [[0, -x, -y, -z], [x, 0, -s * z, s * y], [y, s * z, 0, -s * x], [z, -s * y, s * x, 0]]
    )
    return 0.5 * m @ q


def fine(frame: str, q: Quat, end: float, n: int = 2000) -> Array:
    h, y = end / n, np.array(q)
    for i in range(n):
        t = i * h
        k1 = quaternion_rate(frame, t, y)
        k2 = quaternion_rate(frame, t + 0.5 * h, y + 0.5 * h * k1)
        k3 = quaternion_rate(frame, t + 0.5 * h, y + 0.5 * h * k2)
        k4 = quaternion_rate(frame, t + h, y + h * k3)
        y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return y


def coarse(frame: str, q: Quat, end: float, n: int, commutator: float = 1.0) -> Quat:
    """n steps of the code under test.

    A commutator of -1 swaps the ends of each step, which changes its sign.
    """
    step, h = rot.integrate_base if frame == "base" else rot.integrate_body, end / n
    for i in range(n):
        t0, t1 = i * h, (i + 1) * h
        turn = rot.subtract(rate_integral(t1), rate_integral(t0))
        ends = (rate(t0), rate(t1)) if commutator > 0.0 else (rate(t1), rate(t0))
        q = step(q, turn, *ends, h)
    return q


@pytest.mark.parametrize("frame", ["base", "body"])
def test_integration_is_of_fourth_order(frame: str) -> None:
    start = rot.normalise((0.3, -0.5, 0.7, 0.2))
    exact = tuple(fine(frame, start, 4.0))
    right = [rot.geodesic(exact, coarse(frame, start, 4.0, n)) for n in (20, 40, 80)]
    wrong = [
        rot.geodesic(exact, coarse(frame, start, 4.0, n, commutator=-1.0)) for n in (20, 40, 80)
    ]
    assert right[0] / right[1] == pytest.approx(16.0, rel=0.25)
    assert right[1] / right[2] == pytest.approx(16.0, rel=0.1)
    assert wrong[1] / wrong[2] == pytest.approx(4.0, rel=0.1), (
        "the sign of the commutator should matter"
    )
    assert right[2] < 1e-2 * wrong[2]


@pytest.mark.parametrize("n", [20, 80])
def test_base_and_body_rates_are_not_the_same_thing(n: int) -> None:
    start = rot.normalise((0.3, -0.5, 0.7, 0.2))
    assert rot.geodesic(coarse("base", start, 4.0, n), coarse("body", start, 4.0, n)) > 0.5


@given(quaternion, direction, st.floats(-20.0, 20.0))
def test_one_step_about_a_constant_axis_is_exact(q: Quat, axis: Vec3, turn: float) -> None:
    """Whatever the profile of the rate: only its integral counts."""
    ends = rot.scale(0.1, axis), rot.scale(-7.0, axis)
    about = Rotation.from_rotvec(rot.scale(turn, axis))
    base = rot.integrate_base(q, rot.scale(turn, axis), *ends, 0.5)
    body = rot.integrate_body(q, rot.scale(turn, axis), *ends, 0.5)
    assert_allclose(scipy(base).as_matrix(), (about * scipy(q)).as_matrix(), atol=1e-13)
    assert_allclose(scipy(body).as_matrix(), (scipy(q) * about).as_matrix(), atol=1e-13)
