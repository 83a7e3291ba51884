"""Rotation arithmetic against scipy, the group's axioms and a fine integration.

scipy has the scalar last.
"""

from math import cos, inf, isnan, nan, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from rotation_cases import direction, number, quaternion, scipy, vector
from scipy.spatial.transform import Rotation

from atlas_cueing import rotation as rot
from atlas_cueing.rotation import IDENTITY, Quat, Vec3

EPS = 1e-14


# Everywhere, and crowded near no turn, half a turn and a full turn.
near = st.sampled_from([0.0, pi, 2.0 * pi]).flatmap(
    lambda at: st.floats(-12.0, -2.0).flatmap(
        lambda e: st.sampled_from([at - 10.0**e, at + 10.0**e])
    )
)


angle = (st.floats(0.0, 2.0 * pi) | near).map(lambda x: abs(x) % (2.0 * pi))


def same(p: Quat, q: Quat, tolerance: float = EPS) -> None:
    """One orientation, whichever the signs."""
    assert_allclose(p, rot.continuous(q, p), rtol=0.0, atol=tolerance)


def small_turn(axis: Vec3, size: float) -> Quat:
    """Quaternion of a turn, from scalar functions of half its angle alone."""
    s = sin(0.5 * size)
    return (cos(0.5 * size), s * axis[0], s * axis[1], s * axis[2])


@given(quaternion, quaternion, quaternion)
def test_group_axioms(p: Quat, q: Quat, r: Quat) -> None:
    assert_allclose(
        rot.multiply(rot.multiply(p, q), r), rot.multiply(p, rot.multiply(q, r)), atol=EPS
    )
    assert rot.multiply(p, IDENTITY) == p == rot.multiply(IDENTITY, p)
    assert_allclose(rot.multiply(p, rot.conjugate(p)), IDENTITY, atol=EPS)
    assert_allclose(rot.multiply(rot.conjugate(p), p), IDENTITY, atol=EPS)
    assert_allclose(
        rot.conjugate(rot.multiply(p, q)),
        rot.multiply(rot.conjugate(q), rot.conjugate(p)),
        atol=EPS,
    )
    assert np.hypot.reduce(rot.multiply(p, q)) == pytest.approx(1.0, abs=EPS)


def test_hamilton() -> None:
    """i j = k, and a right-handed quarter turn about z takes x to y: the whole convention."""
    i, j, k = (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0)
    assert rot.multiply(i, j) == k
    assert rot.multiply(i, i) == (-1.0, 0.0, 0.0, 0.0)
    assert_allclose(
        rot.rotate((sqrt(0.5), 0.0, 0.0, sqrt(0.5)), (1.0, 0.0, 0.0)), (0.0, 1.0, 0.0), atol=EPS
    )


@given(quaternion, quaternion, vector)
def test_product_and_rotation_are_scipy_s(p: Quat, q: Quat, v: Vec3) -> None:
    same(rot.multiply(p, q), tuple(np.roll((scipy(p) * scipy(q)).as_quat(), 1)))
    assert_allclose(rot.rotate(p, v), scipy(p).apply(v), atol=EPS)
    assert_allclose(rot.rotate(p, rot.rotate(q, v)), rot.rotate(rot.multiply(p, q), v), atol=EPS)
    assert_allclose(rot.rotate(rot.conjugate(p), rot.rotate(p, v)), v, atol=EPS)


@given(quaternion, quaternion)
def test_difference_is_the_turn_from_one_to_the_other(p: Quat, q: Quat) -> None:
    same(rot.difference(p, q), tuple(np.roll((scipy(q) * scipy(p).inv()).as_quat(), 1)))
    assert_allclose(rot.multiply(rot.difference(p, q), p), q, atol=EPS)


@given(vector, vector, number)
def test_vectors_are_numpy_s(a: Vec3, b: Vec3, k: float) -> None:
    assert_allclose(rot.add(a, b), np.add(a, b))
    assert_allclose(rot.subtract(a, b), np.subtract(a, b))
    assert_allclose(rot.scale(k, a), k * np.array(a))
    assert_allclose(rot.cross(a, b), np.cross(a, b), atol=EPS)
    assert rot.dot(a, b) == pytest.approx(np.dot(a, b), abs=EPS)
    assert rot.norm(a) == pytest.approx(np.linalg.norm(a), abs=EPS)
    assert_allclose(rot.apply((a, b, a), b), np.array([a, b, a]) @ b, atol=EPS)


def test_norm_of_what_is_no_length_any_more() -> None:
    assert rot.norm((3e150, 0.0, 4e150)) == pytest.approx(5e150)
    assert rot.norm((3e300, 0.0, 4e300)) == rot.norm((0.0, -inf, 0.0)) == inf
    assert isnan(rot.norm((0.0, nan, 1.0)))


@given(direction, angle)
def test_exp_and_log_there_and_back(axis: Vec3, size: float) -> None:
    phi = rot.scale(size, axis)
    q = rot.exp(phi)
    assert_allclose(q, small_turn(axis, size), rtol=1e-13, atol=1e-15)
    same(q, tuple(np.roll(Rotation.from_rotvec(phi).as_quat(), 1)))
    shorter = size if size <= pi else size - 2.0 * pi
    back = rot.log(q)
    assert rot.norm(back) <= pi + EPS
    if abs(size - pi) > 1e-12:  # either way round at half a turn
        assert_allclose(
            back, rot.scale(shorter, axis), rtol=1e-12, atol=1e-15 if size < 1.0 else 1e-14
        )
        assert_allclose(back, scipy(q).as_rotvec(), rtol=1e-9, atol=1e-12)
    same(rot.exp(back), q)


@given(direction, angle)
def test_log_unwound_keeps_the_longer_way(axis: Vec3, size: float) -> None:
    if 2.0 * pi - size > 1e-13:
        found = rot.log_unwound(small_turn(axis, size))
        # half a unit in the last place of w or x is all the quaternion knows about the axis near a
        # full turn
        assert_allclose(
            found, rot.scale(size, axis), rtol=0.0, atol=1e-14 / max(2.0 * pi - size, 1e-2) + 1e-14
        )
        assert_allclose(rot.exp(found), small_turn(axis, size), atol=EPS)


@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-160, 1e-20, 9.99e-5, 1e-4, 1.001e-4, 1e-3])
def test_small_turns_keep_their_relative_precision(size: float) -> None:
    """On both sides of where the series takes over, and where squares underflow."""
    phi = (0.6 * size, 0.0, -0.8 * size)
    assert_allclose(rot.exp(phi)[1:], np.array(phi) * (0.5 - size**2 / 48.0), rtol=1e-14, atol=0.0)
    assert_allclose(rot.log(rot.exp(phi)), phi, rtol=1e-13, atol=0.0)
    assert_allclose(rot.log(tuple(-x for x in rot.exp(phi))), phi, rtol=1e-13, atol=0.0)


def test_a_full_turn_has_its_length() -> None:
    assert rot.log((-1.0, 0.0, 0.0, 0.0)) == rot.log(IDENTITY) == (0.0, 0.0, 0.0)
    assert rot.norm(rot.log_unwound((-1.0, 0.0, 0.0, 0.0))) == 2.0 * pi
    assert rot.norm(rot.log_unwound(small_turn((0.0, 1.0, 0.0), 2.0 * pi - 1e-9))) == pytest.approx(
        2.0 * pi - 1e-9
    )


@given(quaternion, quaternion)
def test_continuous_picks_the_nearer_sign(p: Quat, q: Quat) -> None:
    found = rot.continuous(q, p)
    assert found in (q, tuple(-x for x in q))
    assert np.dot(found, p) >= 0.0
    assert rot.continuous(found, p) == found


@given(st.floats(0.1, 10.0), quaternion)
def test_normalise(size: float, q: Quat) -> None:
    found = rot.normalise((size * q[0], size * q[1], size * q[2], size * q[3]))
    assert_allclose(found, q, atol=EPS)


@given(vector, vector)
def test_angle_between(a: Vec3, b: Vec3) -> None:
    if min(rot.norm(a), rot.norm(b)) < 1e-3:
        return
    u, v = (np.array(x) / np.linalg.norm(x) for x in (a, b))
    kahan = 2.0 * np.arctan2(np.linalg.norm(u - v), np.linalg.norm(u + v))
    assert rot.angle_between(a, b) == pytest.approx(kahan, abs=1e-13)


def test_angle_to_nothing_is_none() -> None:
    assert rot.angle_between((0.0, 0.0, 0.0), (1.0, 2.0, 3.0)) == 0.0
    assert rot.angle_between((0.0, 0.0, 2.0), (0.0, 0.0, -1.0)) == pi


@given(quaternion, quaternion)
def test_geodesic_is_scipy_s_magnitude(p: Quat, q: Quat) -> None:
    assert rot.geodesic(p, q) == pytest.approx((scipy(p).inv() * scipy(q)).magnitude(), abs=1e-13)
    assert rot.geodesic(p, q) == pytest.approx(rot.geodesic(q, p), abs=1e-13)
    assert rot.geodesic(p, tuple(-x for x in p)) == pytest.approx(0.0, abs=1e-7)


@given(direction, direction)
def test_shortest_arc_turns_one_into_the_other(a: Vec3, b: Vec3) -> None:
    q = rot.shortest_arc(rot.scale(3.0, a), rot.scale(0.2, b))
    assert_allclose(rot.rotate(q, a), b, atol=1e-12)
    assert rot.geodesic(IDENTITY, q) == pytest.approx(rot.angle_between(a, b), abs=1e-12)
    assert abs(q[1] * a[0] + q[2] * a[1] + q[3] * a[2]) < 1e-12  # no twist about the vectors


@given(direction, st.floats(-17.0, -3.0))
def test_shortest_arc_of_opposite_vectors(a: Vec3, exponent: float) -> None:
    b = rot.add(rot.scale(-1.0, a), rot.scale(10.0**exponent, rot.cross(a, (a[1], a[2], -a[0]))))
    q = rot.shortest_arc(a, b)
    # the cross product knows its direction only to eps / 10^exponent
    assert_allclose(
        rot.rotate(q, a),
        rot.scale(1.0 / rot.norm(b), b),
        atol=3e-12 + min(1e-15 / 10.0**exponent, 2e-3),
    )
    assert np.hypot.reduce(q) == pytest.approx(1.0, abs=EPS)


@pytest.mark.parametrize("a", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.7, 0.7, 0.0)])
def test_shortest_arc_of_exact_opposites_and_of_nothing(a: Vec3) -> None:
    opposite = rot.scale(-2.0, a)
    assert_allclose(
        rot.rotate(rot.shortest_arc(a, opposite), a), rot.scale(0.5, opposite), atol=1e-14
    )
    assert rot.shortest_arc(a, a) == IDENTITY
    assert rot.shortest_arc(a, (0.0, 0.0, 0.0)) == IDENTITY


@given(st.floats(-pi, pi), st.floats(-0.499 * pi, 0.499 * pi), st.floats(-pi, pi))
def test_euler_there_and_back(psi: float, theta: float, phi: float) -> None:
    q = rot.from_euler(psi, theta, phi)
    same(q, tuple(np.roll(Rotation.from_euler("ZYX", (psi, theta, phi)).as_quat(), 1)))
    found = np.array(rot.to_euler(q)) - (psi, theta, phi)
    assert_allclose((found + pi) % (2.0 * pi) - pi, 0.0, atol=1e-9)
    same(rot.from_euler(*rot.to_euler(q)), q, 1e-11)


@given(
    st.floats(-pi, pi),
    st.sampled_from([-1.0, 1.0]),
    st.floats(-pi, pi),
    st.sampled_from([0.0, 1e-13, 1e-9, 1e-7, 1e-5]),
)
def test_euler_straight_up_and_down(psi: float, sign: float, phi: float, off: float) -> None:
    """The orientation comes back although the angles are not unique.

    Within 1.5e-6 rad of vertical it is put to vertical.
    """
    q = rot.from_euler(psi, sign * (0.5 * pi - off), phi)
    angles = rot.to_euler(q)
    assert abs(angles[1]) == pytest.approx(0.5 * pi, abs=off + 2e-6)
    same(rot.from_euler(*angles), q, 2e-6)


@given(quaternion, vector)
def test_flip_rotation_is_a_change_of_both_frames(q: Quat, v: Vec3) -> None:
    D = np.diag([1.0, -1.0, -1.0])
    assert_allclose(scipy(rot.flip_rotation(q)).as_matrix(), D @ scipy(q).as_matrix() @ D, atol=EPS)
    assert_allclose(rot.flip(v), D @ v)
    assert_allclose(
        rot.rotate(rot.flip_rotation(q), rot.flip(v)), rot.flip(rot.rotate(q, v)), atol=EPS
    )
    assert rot.flip_rotation(rot.flip_rotation(q)) == q
