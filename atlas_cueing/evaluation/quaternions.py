"""Quaternions of a whole run at a time, (n, 4), scalar first; `rotation` has the same for one."""

import numpy as np

from .flight import Array

_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])


def multiply(p: Array, q: Array) -> Array:
    """Hamilton products, row by row; either may be a single quaternion."""
    a, b, c, d = np.moveaxis(p, -1, 0)
    w, x, y, z = np.moveaxis(q, -1, 0)
    return np.stack(
        [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w,
        ],
        axis=-1,
    )


def geodesic(p: Array, q: Array) -> Array:
    """Angle (rad, 0 to pi, (n,)) of the rotation from p to q, row by row."""
    d = multiply(p * _CONJUGATE, q)
    angle: Array = 2.0 * np.arctan2(np.linalg.norm(d[..., 1:], axis=-1), np.abs(d[..., 0]))
    return angle


def exp(phi: Array) -> Array:
    """Unit quaternions of rotation vectors (n, 3) in rad."""
    half = 0.5 * np.linalg.norm(phi, axis=-1, keepdims=True)
    return np.concatenate([np.cos(half), 0.5 * np.sinc(half / np.pi) * phi], axis=-1)
