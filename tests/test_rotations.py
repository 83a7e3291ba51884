"""Quaternion arrays against scipy and the scalar arithmetic."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing import rotation
from atlas_cueing.rotations import accumulated, cross, exp, geodesic, multiply, rotate, rotate_back

RANDOM = np.random.default_rng(3)
P, Q = (Rotation.random(50, rng=RANDOM) for _ in range(2))


def quats(r: Rotation) -> np.ndarray:
    return r.as_quat(scalar_first=True)


VECTORS = RANDOM.normal(size=(2, 50, 3))


def test_cross_is_that_of_numpy_to_the_last_bit() -> None:
    np.testing.assert_array_equal(cross(*VECTORS), np.cross(*VECTORS))
    np.testing.assert_array_equal(cross(*VECTORS[:, ::3]), np.cross(*VECTORS[:, ::3]))


def test_vectors_turn_as_scipy_turns_them_and_back() -> None:
    v, _ = VECTORS
    np.testing.assert_allclose(rotate(quats(P), v), P.apply(v), rtol=0, atol=1e-14)
    np.testing.assert_allclose(rotate_back(quats(P), v), P.inv().apply(v), rtol=0, atol=1e-14)


def test_multiply_is_composition() -> None:
    found = Rotation.from_quat(multiply(quats(P), quats(Q)), scalar_first=True)
    assert np.max((found.inv() * (P * Q)).magnitude()) < 1e-14


def test_a_single_quaternion_multiplies_all() -> None:
    np.testing.assert_array_equal(
        multiply(quats(P)[0], quats(Q))[7], multiply(quats(P)[0], quats(Q)[7])
    )


def test_geodesic_whatever_the_signs() -> None:
    expected = (P.inv() * Q).magnitude()
    np.testing.assert_allclose(geodesic(quats(P), quats(Q)), expected, atol=1e-12)
    np.testing.assert_allclose(geodesic(-quats(P), quats(Q)), expected, atol=1e-12)


@pytest.mark.parametrize(
    "angle", [0.0, 1e-300, 1e-12, 1e-8, 1e-4, 1.0, np.pi - 1e-9, np.pi, 5.0, 100.0]
)
def test_exp_is_that_of_rotation(angle: float) -> None:
    phi = angle * np.array([0.6, -0.64, 0.48])
    np.testing.assert_allclose(
        exp(phi[None])[0], rotation.exp(tuple(phi.tolist())), rtol=0, atol=1e-14
    )


@pytest.mark.parametrize("angle", [1e-12, 1e-8, 1e-3, 3.0, np.pi - 1e-9])
def test_small_and_large_angles_keep_their_digits(angle: float) -> None:
    q = exp(np.array([[0.0, angle, 0.0]]))
    assert geodesic(np.array([[1.0, 0.0, 0.0, 0.0]]), q)[0] == pytest.approx(angle, rel=1e-12)


@pytest.mark.parametrize("n", [0, 1, 2, 3, 8, 9, 10, 50, 1000])
def test_turns_accumulate_one_after_the_other(n: int) -> None:
    turns = quats(Rotation.random(n, rng=RANDOM)) if n else np.empty((0, 4))
    expected = [rotation.normalise((0.1, 0.2, -0.3, 0.4))]
    for turn in turns.tolist():
        expected.append(rotation.multiply((turn[0], turn[1], turn[2], turn[3]), expected[-1]))
    np.testing.assert_allclose(
        accumulated(np.array(expected[0]), turns), expected, rtol=0, atol=1e-13
    )
