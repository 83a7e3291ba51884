"""A track as a smooth curve through points: its derivatives, tangent, curvature and height.

A quintic spline r(u), u being the distances between the points added up, so that curvature and its
rate are smooth. Of a closed track the spline is periodic.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from ..rotations import Array, length

_DEGREE = 5


@dataclass(frozen=True, slots=True)
class Way:
    """The track at places u (n,), m.

    first, second: derivatives by u (n, 3). stretch: |dr/du| (n,). tangent: t (n, 3). curvature:
    dt/ds (n, 3), 1/m. height: (n,) m. Vectors are in N.
    """

    u: Array
    first: Array
    second: Array
    stretch: Array
    tangent: Array
    curvature: Array
    height: Array

    def every(self, step: int, count: int) -> "Way":
        """Return every `step`-th place, `count` of them."""
        part = slice(0, step * count, step)
        return Way(
            *(self.u[part], self.first[part], self.second[part], self.stretch[part]),
            *(self.tangent[part], self.curvature[part], self.height[part]),
        )


def spline_through(points: Array, closed: bool) -> tuple[BSpline, float]:
    """Return the curve over u through points (n, 3), and its length in u, m."""
    u, through = _along(points, closed)
    curve = _through(u, through[:, :], closed, _DEGREE)
    return curve, float(u[-1])


def bank_along(u: Array, points: Array, bank: Array, closed: bool) -> Array:
    """Return the banks (n,), rad, at places u between those of the points."""
    at, _ = _along(points, closed)
    angles = np.concatenate([bank, bank[:1]]) if closed else bank
    banks: Array = _through(at, angles, closed, 3)(u)
    return banks


def _along(points: Array, closed: bool) -> tuple[Array, Array]:
    through = np.concatenate([points, points[:1]]) if closed else points
    return np.concatenate([[0.0], np.cumsum(length(np.diff(through, axis=0)))]), through


def _through(u: Array, values: Array, closed: bool, degree: int) -> BSpline:
    if not closed:
        return make_interp_spline(u, values, k=degree)
    around = make_interp_spline(u, values, k=degree, bc_type="periodic")
    return BSpline(around.t, around.c, degree, extrapolate="periodic")


def way_at(curve: BSpline, u: Array) -> Way:
    """Return the track at places u (n,)."""
    first, second = curve(u, nu=1), curve(u, nu=2)
    stretch = length(first)
    tangent = first / stretch[:, None]
    along = np.einsum("ij,ij->i", second, tangent)
    curvature = (second - tangent * along[:, None]) / (stretch**2)[:, None]
    return Way(u, first, second, stretch, tangent, curvature, -curve(u)[:, 2])
