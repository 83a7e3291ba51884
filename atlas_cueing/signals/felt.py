"""What the rider's head feels, for whole runs at a time."""

import numpy as np
from numpy.typing import ArrayLike

from ..rotations import Array, cross, rotate, rotate_back

STANDARD_GRAVITY = 9.80665  # m/s^2, by definition (CGPM 1901)
_FLU_TO_FRD = np.array([1.0, -1.0, -1.0])


def felt(
    q_WS: ArrayLike, w_WS_W: ArrayLike, alpha_WS_W: ArrayLike, a_WS_W: ArrayLike, head_S: ArrayLike
) -> tuple[Array, Array]:
    """Specific force (m/s^2) and angular rate (rad/s) at the rider's head, (n, 3), FRD axes.

    f = R_SW (a + alpha x r + w x (w x r) - g_W) with r = R_WS head_S and g_W = (0, 0, -9.80665).

    q_WS (n, 4); w_WS_W rad/s, alpha_WS_W rad/s^2, a_WS_W m/s^2 (n, 3) in W; head_S (3,) m from the
    sphere centre in S.
    """
    q, w, alpha, a, head = (
        np.asarray(x, dtype=np.float64) for x in (q_WS, w_WS_W, alpha_WS_W, a_WS_W, head_S)
    )
    force_W = a + np.array([0.0, 0.0, STANDARD_GRAVITY])
    if head.any():
        r = rotate(q, np.broadcast_to(head, w.shape))
        force_W = force_W + cross(alpha, r) + cross(w, cross(w, r))
    return rotate_back(q, force_W) * _FLU_TO_FRD, rotate_back(q, w) * _FLU_TO_FRD


def direction_error(f: ArrayLike, g: ArrayLike) -> Array:
    """Angles (n,), rad, between two specific forces (n, 3); 0 where one of them is zero."""
    f, g = np.asarray(f, dtype=np.float64), np.asarray(g, dtype=np.float64)
    error: Array = np.arctan2(np.linalg.norm(cross(f, g), axis=1), np.sum(f * g, axis=1))
    return error
