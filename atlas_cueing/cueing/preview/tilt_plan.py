"""The rotation of the plan: where W's up points in A, over the whole flight.

All that gravity can do for the force in a cabin depends on that direction m alone. A rider at rest
feels g m in A, so the plan minimises, over the flight,

    mean( |f_A - g m|^2 / force_unit^2 + |m'|^2 / rate_unit^2 )        with |m| = 1, |m'| <= rate,
    |m''| <= acceleration

where m' is what the cabin turns beyond the vehicle (a turn about m itself would only cost). |f_A -
g m|^2 is linear in m on the sphere |m| = 1, so with |m| <= 1 instead the problem is convex: a
second-order cone programme whose minimum is global and no more than that on the sphere. Wherever
the force has a direction worth following its solution lies on the sphere, and then nothing is
better. Where it cuts through the ball (a force that turns over faster than the rate allows), it is
pushed out: -|m| is concave, and its tangents are taken for it, again and again and with growing
weight (convex-concave procedure; A. Yuille & A. Rangarajan, Neural Computation 15, 2003).
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, eye_array, kron

from ...errors import InputError
from ...rotations import Array, cross
from ...signals import STANDARD_GRAVITY
from .preview_parameters import PreviewParameters
from .solver import Bounds, minimise
from .spline import Spline

# of the rate and the acceleration; the rest is for the way from the control points to the unit
# sphere
_PLANNED_SHARE = 0.99
_ON_SPHERE = 0.997  # least length of a control point that passes for one on the unit sphere
_PUSHES = 20  # at most; flights that need any were done after 3 to 12
_PUSH = 0.5  # of the pull of the force, more at each push
_SIDEWAYS = 0.1  # rad, about; how a path straight through the centre begins to pass it on one side


@dataclass(frozen=True, slots=True)
class Up:
    """W's up in A at each tick.

    direction (n, 3): unit vectors m; rate (n, 3): m' x m, rad/s, at which A turns against W, in A.
    """

    direction: Array
    rate: Array


class UpPlanner:
    """Plans the direction of W's up for forces in A, again and again over the same flight."""

    def __init__(self, spline: Spline, parameters: PreviewParameters) -> None:
        """Prepare plans of the control points of `spline`."""
        self._spline, self._parameters = spline, parameters
        self._bounds = turn_bounds(spline, parameters)
        self._bounds.length(csc_array(eye_array(spline.points)), 1.0)
        self._turning = turn_cost(spline, parameters)

    def plan(self, f_A: Array) -> Array:
        """Give control points (points, 3) of the best path of W's up.

        f_A: the specific force at each tick (n, 3), m/s^2, in A.
        Raises InputError when there is none.
        """
        pull = (
            self._spline.value.T
            @ f_A
            * (2.0 * STANDARD_GRAVITY / (self._parameters.force_unit**2 * len(f_A)))
        )
        points = self._solved(pull)
        strength = np.linalg.norm(pull, axis=1, keepdims=True)
        # it has to be pushed where there is no force, too
        strength = np.maximum(strength, np.mean(strength) or 1.0)
        aside = np.linalg.eigh(pull.T @ pull)[1][:, 0]  # across the plane that the force turns in
        for push in range(1, _PUSHES + 1):
            length = np.linalg.norm(points, axis=1, keepdims=True)
            if np.min(length) >= _ON_SPHERE:
                return points
            outward = points + _SIDEWAYS * (1.0 - length) * aside
            outward /= np.linalg.norm(outward, axis=1, keepdims=True)
            points = self._solved(pull + _PUSH * push * strength * outward)
        raise InputError(
            "method 'preview' found no plan for this flight: the force turns over and over without"
            " a direction that the cabin could keep; use another method, or an align_rate_deg_s"
            f" above {np.degrees(self._parameters.rate):g}"
        )

    def _solved(self, pull: Array) -> Array:
        return minimise(self._turning, -pull.ravel(), self._bounds).reshape(-1, 3)


def sampled(spline: Spline, points: Array) -> Up:
    """Give W's up at the ticks, brought onto the unit sphere, for control points (points, 3)."""
    curve, slope = spline.value @ points, spline.slope @ points
    length = np.linalg.norm(curve, axis=1, keepdims=True)
    direction = curve / length
    return Up(direction, cross(slope / length, direction))


def turn_bounds(spline: Spline, parameters: PreviewParameters) -> Bounds:
    """Give the bounds of rate and acceleration on the control points of W's up.

    It is at rest when the flight begins.
    """
    bounds = Bounds()
    bounds.zero(csc_array(kron(spline.difference(1)[:2], eye_array(3))))
    bounds.length(spline.difference(1), _PLANNED_SHARE * parameters.rate)
    bounds.length(spline.difference(2), _PLANNED_SHARE * parameters.acceleration)
    return bounds


def turn_cost(spline: Spline, parameters: PreviewParameters) -> csc_array:
    """Give twice the cost of the rate m' as a quadratic of the control points."""
    weight = 2.0 / (parameters.rate_unit**2 * spline.ticks)
    return csc_array(kron(spline.slope.T @ spline.slope, weight * np.eye(3)))
