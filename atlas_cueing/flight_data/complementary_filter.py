"""An attitude from rates and specific force alone, where a file has none.

A complementary filter (R. Mahony, T. Hamel & J.-M. Pflimlin, IEEE Transactions on Automatic Control
53(5), 2008, without its estimate of bias): the rates are integrated, and the error between the
specific force and the vertical turns the attitude back with the time constant T:

    w' = w + (f_hat x u) / T,     u = R_BN (0, 0, -1): up, in the body's axes

but only where the force could be gravity's, |f| within 10 % of g (assumed): a turn or a push would
be taken for a bank. Heading begins at 0 and follows the rates, so it drifts. The first attitude
hangs by the mean force of the first second.
"""

from collections.abc import Callable

import numpy as np

from ..rotation import (
    Quat,
    Vec3,
    conjugate,
    continuous,
    cross,
    exp,
    multiply,
    normalise,
    scale,
    shortest_arc,
    up_in_body,
)
from ..rotations import Array
from ..signals import STANDARD_GRAVITY

_LIKE_GRAVITY = 0.1  # of g: how far |f| may be off
_OFTEN = 10_000  # ticks between two reports


def filtered_attitude(
    w_B: Array, f_B: Array, dt: float, time: float, progress: Callable[[float], None]
) -> Array:
    """Return q_NB (n, 4) from rates (n, 3), rad/s, and specific forces (n, 3), m/s^2, both FRD.

    time: constant of the filter, s.
    """
    q = _hanging(f_B[: max(round(1.0 / dt), 1)].mean(axis=0))
    attitudes = np.empty((len(w_B), 4))
    attitudes[0] = q
    rates, forces = w_B.tolist(), f_B.tolist()
    for k in range(1, len(w_B)):
        before, now = rates[k - 1], rates[k]
        hung = _correction(q, forces[k - 1], time)
        turn: Vec3 = (
            dt * (0.5 * (before[0] + now[0]) + hung[0]),
            dt * (0.5 * (before[1] + now[1]) + hung[1]),
            dt * (0.5 * (before[2] + now[2]) + hung[2]),
        )
        q = continuous(normalise(multiply(q, exp(turn))), q)
        attitudes[k] = q
        if k % _OFTEN == 0:
            progress(k / len(w_B))
    return attitudes


def _correction(q_NB: Quat, f: list[float], time: float) -> Vec3:
    """Return the rate, rad/s, that turns the attitude towards hanging by the force."""
    size = (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) ** 0.5
    if abs(size - STANDARD_GRAVITY) > _LIKE_GRAVITY * STANDARD_GRAVITY:
        return (0.0, 0.0, 0.0)
    up = scale(-1.0, up_in_body(q_NB))
    return scale(1.0 / (size * time), cross((f[0], f[1], f[2]), up))


def _hanging(f: Array) -> Quat:
    """Return the attitude of heading 0, or near it, whose up is the direction of the force."""
    x, y, z = f.tolist()
    q_BN = shortest_arc((0.0, 0.0, -1.0), (x, y, z)) if (x, y, z) != (0.0, 0.0, 0.0) else None
    return conjugate(q_BN) if q_BN else (1.0, 0.0, 0.0, 0.0)
