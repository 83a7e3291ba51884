"""How far a logged quantity may be from the integral of its logged derivative, when only the jerk is bounded.

Between two ticks, h apart, nothing is logged; whatever the motion does there, its jerk keeps its
limit J. That bounds both quadrature errors rigorously, for any way the actuators go through the
tick.
"""

from math import sqrt

import numpy as np
from numpy.typing import ArrayLike

from ...rotations import Array

# Largest error of h/2 (v0 + v1) + h^2/12 (a0 - a1) for the integral of v with |v''| <= J, over J
# h^3: the integral of |t (1 - t)/2 - 1/12| over the unit interval.
TURN = sqrt(3.0) / 54.0


def speed_error(a: Array, h: Array, jerk: ArrayLike) -> Array:
    """Bound on |v1 - v0 - h/2 (a0 + a1)| for each step of a (n, k): (J h^2 - (a1 - a0)^2 / J) / 4."""
    J = np.asarray(jerk, dtype=np.float64)
    bound: Array = 0.25 * np.maximum(J * h[:, None] ** 2 - np.diff(a, axis=0) ** 2 / J, 0.0)
    return bound


def turn_error(h: Array, jerk: ArrayLike) -> Array:
    """Bound on |x1 - x0 - `turn`| for each step (n - 1, k)."""
    bound: Array = TURN * h[:, None] ** 3 * np.asarray(jerk, dtype=np.float64)
    return bound


def mean_step(v: Array, h: Array) -> Array:
    """Change over each step by the trapezoid rule, (n - 1, k)."""
    step: Array = 0.5 * h[:, None] * (v[:-1] + v[1:])
    return step


def turn(v: Array, a: Array, h: Array) -> Array:
    """Change over each step by the corrected trapezoid rule.

    H/2 (v0 + v1) + h^2/12 (a0 - a1), (n - 1, k).
    """
    step: Array = mean_step(v, h) + (h * h / 12.0)[:, None] * (a[:-1] - a[1:])
    return step
