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


def accumulated(q: Array, turns: Array) -> Array:
    """Orientations (n + 1, 4): q (4,), then each turn (n, 4) after what was before, t_k o ... o t_1 o q.

    Blocks of about sqrt(n) turns are multiplied up side by side, and then put one behind the other.
    """
    size = max(round(len(turns) ** 0.5), 1)
    blocks = -(-len(turns) // size)
    products = np.zeros((blocks * size, 4))
    products[:, 0] = 1.0
    products[: len(turns)] = turns
    products = products.reshape(blocks, size, 4)
    for k in range(1, size):
        products[:, k] = multiply(products[:, k], products[:, k - 1])
    begin = q
    for block in products:
        block[:] = multiply(block, begin)
        begin = block[-1]
    return np.concatenate([q[None], products.reshape(-1, 4)[: len(turns)]])
