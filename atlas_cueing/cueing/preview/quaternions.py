"""Rotations of a whole flight at a time, one row each, scalar first.

`rotation` has the same for one.
"""

import numpy as np

from .spline import Array


def rotated(q_AB: Array, v_B: Array) -> Array:
    """Vectors (n, 3) seen from the outer frame, row by row."""
    u, w = q_AB[:, 1:], q_AB[:, :1]
    t = 2.0 * np.cross(u, v_B)
    return np.asarray(v_B + w * t + np.cross(u, t))


def back(q_AB: Array, v_A: Array) -> Array:
    """Vectors (n, 3) seen from the inner frame, row by row: the inverse of `rotated`."""
    return rotated(q_AB * np.array([1.0, -1.0, -1.0, -1.0]), v_A)


def product(p: Array, q: Array) -> Array:
    """Hamilton products, row by row."""
    w = p[:, :1] * q[:, :1] - np.sum(p[:, 1:] * q[:, 1:], axis=1, keepdims=True)
    return np.hstack([w, p[:, :1] * q[:, 1:] + q[:, :1] * p[:, 1:] + np.cross(p[:, 1:], q[:, 1:])])
