"""The stage of the plan: the best motion inside the travel, axis by axis of W.

The stage should have the acceleration d that the rider's head lacks. A cubic spline p(t) has a
constant jerk between knots; the plan minimises mean((p'' - d)^2) over the whole flight with |p|,
|p'|, |p''|, |p'''| within the limits, from rest in the centre to rest. Speeds and accelerations of
the control points are unknowns of their own, tied to the positions by equations: with positions
alone, whose third differences count by 1 / interval^3, the solver runs out of digits on long
flights.
"""

import numpy as np
from scipy.sparse import csc_array, diags_array, eye_array, hstack, vstack

from ...rotations import Array
from ...signals import StageLimits
from .solver import Bounds, minimise
from .spline import Spline, steps

_PLANNED_SHARE = 0.98  # of every limit; smoothing keeps a little of each
# of acceleration and jerk towards the ends of the travel; smoothing goes there with 0.7 of each
_BRAKING_SHARE = 0.55
# 1/s; of the straight lines that bound the speed towards the ends of the travel
_SLOPES = (8.0, 4.0, 2.0)


def plan_stage(spline: Spline, d_W: Array, limits: StageLimits) -> Array:
    """Give control points (points, 3) of the stage's position, m, in W.

    d_W: the demand (ticks, 3), m/s^2, in W.
    Raises InputError when the solver fails.
    """
    push = acceleration(spline)
    quadratic = csc_array(push.T @ push) * (2.0 / spline.ticks)
    linear = push.T @ d_W * (-2.0 / spline.ticks)
    axes = [minimise(quadratic, linear[:, i], stage_bounds(spline, limits, i)) for i in range(3)]
    return np.stack([x[: spline.points] for x in axes], axis=1)


def acceleration(spline: Spline) -> csc_array:
    """Give the matrix from the unknowns of one axis to its acceleration at the ticks.

    The unknowns are positions, speeds and accelerations of the control points.
    """
    return csc_array(hstack([csc_array((spline.ticks, 2 * spline.points - 1)), spline.straight()]))


def stage_bounds(spline: Spline, limits: StageLimits, axis: int) -> Bounds:
    """Give the bounds that the unknowns of one axis of the stage must keep."""
    n, h = spline.points, spline.interval
    most = (limits.travel[axis], limits.speed[axis], limits.acceleration[axis])
    bounds = Bounds()
    bounds.zero(_tied(n, h))
    bounds.zero(_at_rest(n, 4 if spline.ends_between_ticks else 3))
    sizes = np.concatenate([np.full(n - order, 1.0 / bound) for order, bound in enumerate(most)])
    bounds.within(csc_array(diags_array(sizes)), _PLANNED_SHARE)
    jerk = hstack([csc_array((n - 3, 2 * n - 1)), steps(n - 2) / (h * limits.jerk[axis])])
    bounds.within(csc_array(jerk), _PLANNED_SHARE)
    for slope in _SLOPES:
        ahead = hstack(
            [slope * eye_array(n - 1, n, k=1), eye_array(n - 1), csc_array((n - 1, n - 2))]
        )
        bounds.within(
            csc_array(ahead),
            slope * _PLANNED_SHARE * limits.travel[axis]
            + _spare(slope, most[2], limits.jerk[axis]),
        )
    return bounds


def _spare(slope: float, acceleration: float, jerk: float) -> float:
    """Give the speed v0 (m/s) of the line v = v0 + slope d that touches the stopping curve.

    That is the speed from which a stop takes the distance d. A stop from v takes
    v/2 (v / A + A / J), so that v = sqrt(2 A d + h^2) - h with h = A^2 / 2J.
    """
    a, h = _BRAKING_SHARE * acceleration, 0.5 * _BRAKING_SHARE * acceleration**2 / jerk
    root = a / slope
    return (root - h) ** 2 / (2.0 * root) if root > h else 0.0


def _tied(n: int, h: float) -> csc_array:
    """Differences of positions are speeds, differences of speeds accelerations."""
    first = hstack([steps(n), -h * eye_array(n - 1), csc_array((n - 1, n - 2))])
    second = hstack([csc_array((n - 2, n)), steps(n - 1), -h * eye_array(n - 2)])
    return csc_array(vstack([first, second]))


def _at_rest(n: int, last: int) -> csc_array:
    """Give the matrix of what is zero: position, speed and acceleration at the start, and the end.

    The speeds between the `last` control points are zero, so that these are one and the same.
    """
    last = min(last, n)
    columns = [0, n, n + 1, *range(2 * n - last, 2 * n - 1)]
    return csc_array(
        (np.ones(len(columns)), (np.arange(len(columns)), columns)), shape=(len(columns), 3 * n - 3)
    )
