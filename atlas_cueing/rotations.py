"""Vectors and quaternions of many ticks at a time: rows (n, 3) and (n, 4), scalar first.

`rotation` has the same for one. Results have each component contiguous.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])


def length(v: Array) -> Array:
    """Euclidean lengths (n,) of the rows of v (n, k)."""
    norms: Array = np.sqrt(np.einsum("ij,ij->i", v, v))
    return norms


def multiply(p: Array, q: Array) -> Array:
    """Hamilton products, row by row; either may be a single quaternion."""
    a, b, c, d = np.moveaxis(p, -1, 0)
    w, x, y, z = np.moveaxis(q, -1, 0)
    return np.array(
        [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y - b * z + c * w + d * x,
            a * z + b * y - c * x + d * w,
        ]
    ).T


def geodesic(p: Array, q: Array) -> Array:
    """Angle (rad, 0 to pi, (n,)) of the rotation from p to q, row by row."""
    d = multiply(p * _CONJUGATE, q)
    angle: Array = 2.0 * np.arctan2(length(d[:, 1:]), np.abs(d[:, 0]))
    return angle


def exp(phi: Array) -> Array:
    """Unit quaternions of rotation vectors (n, 3) in rad."""
    half = 0.5 * length(phi)
    scale = 0.5 * np.sinc(half / np.pi)
    return np.array([np.cos(half), *(scale * phi.T)]).T


def accumulated(q: Array, turns: Array) -> Array:
    """Orientations (n + 1, 4): q (4,), then each turn (n, 4) after what was before, t_k o ... o t_1 o q."""
    return np.concatenate([q[None], multiply(_running(turns), q)])


def _running(turns: Array) -> Array:
    """Products t_k o ... o t_1, (n, 4): those of pairs of turns first, then every other one from those; 2 n multiplications."""
    if len(turns) < 2:
        return turns
    pairs = _running(multiply(turns[1::2], turns[:-1:2]))
    running = np.empty_like(turns)
    running[0], running[1::2] = turns[0], pairs
    running[2::2] = multiply(turns[2::2], pairs[: (len(turns) - 1) // 2])
    return running
