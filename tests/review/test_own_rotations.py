"""Review's own rotations against scipy's, which neither the log's writer nor review uses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from atlas_cueing.review.own_rotations import (
    cross,
    from_vector,
    inverse,
    product,
    to_matrix,
    to_vector,
    turned,
    turned_back,
)

vectors = st.lists(st.tuples(*[st.floats(-3.0, 3.0)] * 3), min_size=1, max_size=5).map(np.array)
ROWS = np.random.default_rng(3).normal(size=(50, 3))
OTHERS = np.random.default_rng(4).normal(size=(50, 3))


def scipy(q: np.ndarray) -> Rotation:
    return Rotation.from_quat(q[:, [1, 2, 3, 0]])


@given(vectors)
def test_there_and_back(phi: np.ndarray) -> None:
    q = from_vector(phi)
    assert np.linalg.norm(q, axis=1) == pytest.approx(1.0)
    assert scipy(q).as_rotvec() == pytest.approx(Rotation.from_rotvec(phi).as_rotvec(), abs=1e-9)
    assert from_vector(to_vector(q)) * np.sign(
        np.sum(from_vector(to_vector(q)) * q, axis=1, keepdims=True)
    ) == pytest.approx(q)


@pytest.mark.parametrize("angle", [0.0, 1e-300, 1e-12, 1e-9, 1e-8, 1e-4, np.pi - 1e-9])
def test_small_and_large_angles(angle: float) -> None:
    phi = np.array([[0.6 * angle, 0.0, -0.8 * angle]])
    assert to_vector(from_vector(phi)) == pytest.approx(phi, rel=1e-9, abs=1e-300)


def test_products_and_inverses() -> None:
    p, q = from_vector(ROWS), from_vector(OTHERS)
    assert to_matrix(product(p, q)) == pytest.approx((scipy(p) * scipy(q)).as_matrix())
    assert to_matrix(inverse(p)) == pytest.approx(scipy(p).inv().as_matrix())


def test_turning_vectors() -> None:
    q = from_vector(ROWS)
    assert turned(q, OTHERS) == pytest.approx(scipy(q).apply(OTHERS))
    assert turned_back(q, OTHERS) == pytest.approx(scipy(q).apply(OTHERS, inverse=True))
    assert turned(q, OTHERS[0]) == pytest.approx(scipy(q).apply(OTHERS[0]))
    assert np.array_equal(cross(ROWS, OTHERS), np.cross(ROWS, OTHERS))
