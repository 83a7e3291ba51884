"""Bounds on a logged quantity less the integral of its logged derivative.

Between two ticks, h apart, nothing is logged; but the jerk keeps its limit J there. That bounds
both quadrature errors rigorously, however the actuators move within the tick.
"""

from math import sqrt

import numpy as np
from numpy.typing import ArrayLike

from ...rotations import Array

# Largest error of h/2 (v0 + v1) + h^2/12 (a0 - a1) for the integral of v with |v''| <= J, over J
# h^3: the integral of |t (1 - t)/2 - 1/12| over the unit interval.
TURN = sqrt(3.0) / 54.0


def speed_error(a: Array, h: Array, jerk: ArrayLike) -> Array:
    """Bound on |v1 - v0 - h/2 (a0 + a1)| for each step, (n - 1, k).

    It is (J h^2 - (a1 - a0)^2 / J) / 4, for accelerations a (n, k), steps h (n - 1,) in s, and the
    limit J of the jerk of each component.
    """
    J = np.asarray(jerk, dtype=np.float64)
    bound: Array = 0.25 * np.maximum(J * h[:, None] ** 2 - np.diff(a, axis=0) ** 2 / J, 0.0)
    return bound


def turn_error(h: Array, jerk: ArrayLike) -> Array:
    """Bound on |x1 - x0 - turn| for each step, (n - 1, k); `turn` is the change expected."""
    bound: Array = TURN * h[:, None] ** 3 * np.asarray(jerk, dtype=np.float64)
    return bound


def mean_step(v: Array, h: Array) -> Array:
    """Change (n - 1, k) over each step h (n - 1,) by the trapezoidal rule, from rates v (n, k)."""
    step: Array = 0.5 * h[:, None] * (v[:-1] + v[1:])
    return step


def turn(v: Array, a: Array, h: Array) -> Array:
    """Change (n - 1, k) over each step h (n - 1,) by the corrected trapezoidal rule.

    It is h/2 (v0 + v1) + h^2/12 (a0 - a1), from rates v and accelerations a, (n, k).
    """
    step: Array = mean_step(v, h) + (h * h / 12.0)[:, None] * (a[:-1] - a[1:])
    return step
