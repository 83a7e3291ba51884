"""Rotations of a whole run as quaternions and matrices, for review alone.

On purpose this repeats part of `rotation` and `rotations`: what made a log is not used to judge it,
so that an error there cannot hide itself. It is written by other formulas where there are any.

Quaternions are (n, 4), scalar first; `q_AB` turns B-vectors into A-vectors; angles in rad.
"""

import numpy as np

from ..rotations import Array


def product(p: Array, q: Array) -> Array:
    """Hamilton products p q, row by row: scalar p0 q0 - p.q, vector p0 q + q0 p + p x q."""
    scalar = p[:, :1] * q[:, :1] - np.sum(p[:, 1:] * q[:, 1:], axis=1, keepdims=True)
    vector = p[:, :1] * q[:, 1:] + q[:, :1] * p[:, 1:] + cross(p[:, 1:], q[:, 1:])
    return np.hstack([scalar, vector])


def inverse(q: Array) -> Array:
    """Inverses of unit quaternions (n, 4)."""
    return np.hstack([q[:, :1], -q[:, 1:]])


def from_vector(phi: Array) -> Array:
    """Quaternions (n, 4) of rotation vectors (n, 3), rad."""
    angle = np.linalg.norm(phi, axis=1, keepdims=True)
    # sin(angle/2)/angle; below 1e-8 rad its series is 1/2 to the last bit
    factor = np.where(angle > 1e-8, np.sin(0.5 * angle) / np.where(angle > 1e-8, angle, 1.0), 0.5)
    return np.hstack([np.cos(0.5 * angle), factor * phi])


def to_vector(q: Array) -> Array:
    """Rotation vectors (n, 3), rad, of quaternions (n, 4), the shorter way round."""
    q = np.where(q[:, :1] < 0.0, -q, q)
    sine = np.linalg.norm(q[:, 1:], axis=1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, q[:, :1])
    vector: Array = q[:, 1:] * np.where(
        sine > 1e-12, angle / np.where(sine > 1e-12, sine, 1.0), 2.0
    )
    return vector


def to_matrix(q: Array) -> Array:
    """Rotation matrices R_AB (n, 3, 3) of q_AB (n, 4)."""
    w, x, y, z = q.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def turned_back(q_AB: Array, v_A: Array) -> Array:
    """Vectors (n, 3) in B, of vectors (n, 3) in A."""
    turned: Array = np.einsum("nij,ni->nj", to_matrix(q_AB), v_A)
    return turned


def turned(q_AB: Array, v_B: Array) -> Array:
    """Vectors (n, 3) in A, of vectors (n, 3) or one (3,) in B."""
    result: Array = np.einsum("nij,nj->ni", to_matrix(q_AB), np.broadcast_to(v_B, (len(q_AB), 3)))
    return result


def cross(a: Array, b: Array) -> Array:
    """Cross products of rows (n, 3); np.cross takes twice as long."""
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=1)
