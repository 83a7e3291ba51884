"""The torque-free rigid body, exactly: Euler's equations in Jacobi's elliptic functions.

With principal moments I1, I2, I3, the momentum's square M^2 = sum I_i^2 w_i^2 and twice the energy
2E = sum I_i w_i^2, of a body that circulates about its axis 3 (L. Landau & E. Lifshitz, Mechanics,
section 37):

    w1 = a1 cn u,   w2 = s a2 sn u,   w3 = a3 dn u,     u = n t + u0,   s = sign(I3 - I2)
    a1^2 = (2E I3 - M^2) / (I1 (I3 - I1)),   a2^2 = (2E I3 - M^2) / (I2 (I3 - I2))
    a3^2 = (M^2 - 2E I1) / (I3 (I3 - I1)),   n^2 = (I3 - I2)(M^2 - 2E I1) / (I1 I2 I3)
    k^2 = (I2 - I1)(2E I3 - M^2) / ((I3 - I2)(M^2 - 2E I1))

for I1 <= I2 < I3 where M^2 > 2E I2, and for I1 >= I2 > I3 where not. The momentum stands still in
space, so the attitude is known but for the turn phi about it, whose rate never changes its sign:

    phi' = M (I1 w1^2 + I2 w2^2) / (I1^2 w1^2 + I2^2 w2^2)

It is integrated by Gauss's quadrature. Rates come from the time itself, so that nothing adds up in
them, and the attitude keeps the momentum's direction by construction.
"""

from math import atan2, ceil, copysign, cos, hypot, sin, sqrt

import numpy as np

from ..rotation import (
    Mat3,
    Quat,
    Vec3,
    apply,
    conjugate,
    continuous,
    exp,
    multiply,
    norm,
    normalise,
    scale,
)

_STEADY = 1e-13  # |w'| over |w|^2: a turn about a principal axis
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_LONGEST = 0.25  # rad that the body may turn in one quadrature of eight nodes


class EulerTop:
    """A free rigid body, its axes being principal axes.

    `rates` gives the body rates at any time, `attitude` leads the attitude along.
    """

    def __init__(self, inertia: Vec3, w_B: Vec3, q_NB: Quat) -> None:
        """Start with principal moments (kg m^2, positive), rates (rad/s) and attitude."""
        self._w0, self._q0, self._q_NB = w_B, q_NB, q_NB
        self._time, self._phi = 0.0, 0.0
        self._steady = norm(rate_of_change(inertia, w_B)) <= _STEADY * norm(w_B) ** 2
        if self._steady:
            return
        self._axes = _circulating(inertia, w_B)
        self._q_PB = _quaternion(self._axes)
        self._solve(inertia, w_B)
        self._q_NL = multiply(q_NB, conjugate(self._q_LB(0.0)))

    def rates(self, time: float) -> Vec3:
        """Return the body rates at `time` (s), rad/s."""
        if self._steady:
            return self._w0
        return apply(_transposed(self._axes), self._rates_P(time))

    def attitude(self, time: float) -> Quat:
        """Return q_NB at `time` (s), which is not before the one asked for last."""
        if self._steady:
            q_NB = multiply(self._q0, exp(scale(time, self._w0)))
        else:
            self._phi += self._precession(self._time, time)
            q_NB = multiply(self._q_NL, self._q_LB(time))
        self._time = time
        self._q_NB = continuous(normalise(q_NB), self._q_NB)
        return self._q_NB

    def _solve(self, inertia: Vec3, w_B: Vec3) -> None:
        """Find amplitudes, modulus, frequency and phase, in the axes 1, 2, 3."""
        from scipy.special import ellipkinc  # takes a second to import

        i1, i2, i3 = (_moment(row, inertia) for row in self._axes)
        w1, w2, w3 = apply(self._axes, w_B)
        # 2E I3 - M^2 and M^2 - 2E I1, as sums of terms of one sign
        above = i1 * (i3 - i1) * w1 * w1 + i2 * (i3 - i2) * w2 * w2
        below = i2 * (i2 - i1) * w2 * w2 + i3 * (i3 - i1) * w3 * w3
        self._moments = (i1, i2, i3)
        self._momentum = hypot(i1 * w1, i2 * w2, i3 * w3)
        self._a1 = sqrt(above / (i1 * (i3 - i1)))
        self._a2 = copysign(sqrt(above / (i2 * (i3 - i2))), i3 - i2)
        self._a3 = sqrt(below / (i3 * (i3 - i1)))
        self._n = sqrt((i3 - i2) * below / (i1 * i2 * i3))
        self._k2 = min((i2 - i1) * above / ((i3 - i2) * below), 1.0)
        self._u0 = float(ellipkinc(atan2(w2 / self._a2, w1 / self._a1), self._k2))

    def _rates_P(self, time: float) -> Vec3:
        from scipy.special import ellipj

        sn, cn, dn, _ = ellipj(self._n * time + self._u0, self._k2)
        return (self._a1 * float(cn), self._a2 * float(sn), self._a3 * float(dn))

    def _precession(self, begin: float, end: float) -> float:
        """Return the turn about the momentum between two times, rad."""
        from scipy.special import ellipj

        pieces = max(ceil((end - begin) * norm(self._w0) / _LONGEST), 1)
        h = (end - begin) / pieces
        times = begin + h * (np.arange(pieces)[:, None] + 0.5 + 0.5 * _NODES)
        sn, cn, _, _ = ellipj(self._n * times + self._u0, self._k2)
        i1, i2, _ = self._moments
        x, y = (self._a1 * cn) ** 2, (self._a2 * sn) ** 2
        rate = self._momentum * (i1 * x + i2 * y) / (i1 * i1 * x + i2 * i2 * y)
        return float(0.5 * h * np.sum(rate * _WEIGHTS))

    def _q_LB(self, time: float) -> Quat:
        """Return the attitude in axes L whose z is the momentum: turns about z, x and z.

        In the body's axes the momentum is M (sin theta sin psi, sin theta cos psi, cos theta).
        """
        (i1, i2, i3), (w1, w2, w3) = self._moments, self._rates_P(time)
        theta = atan2(hypot(i1 * w1, i2 * w2), i3 * w3)
        tilted: Quat = (cos(0.5 * theta), sin(0.5 * theta), 0.0, 0.0)
        q_LP = multiply(multiply(_about_z(self._phi), tilted), _about_z(atan2(i1 * w1, i2 * w2)))
        return multiply(q_LP, self._q_PB)


def rate_of_change(inertia: Vec3, w: Vec3) -> Vec3:
    """Return w' (rad/s^2) of the free body, by Euler's equations: I w' = I w x w."""
    (a, b, c), (x, y, z) = inertia, w
    return ((b - c) / a * y * z, (c - a) / b * z * x, (a - b) / c * x * y)


def _circulating(inertia: Vec3, w: Vec3) -> Mat3:
    """Return the axes 1, 2, 3 as rows in body axes: a proper rotation with w3 > 0 and w1 >= 0."""
    low, middle, high = sorted(range(3), key=lambda axis: inertia[axis])
    # M^2 - 2E I2, by terms
    above = inertia[high] * (inertia[high] - inertia[middle]) * w[high] ** 2
    below = inertia[low] * (inertia[middle] - inertia[low]) * w[low] ** 2
    order = (low, middle, high) if above > below else (high, middle, low)
    odd = order in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
    s1, s3 = copysign(1.0, w[order[0]]), copysign(1.0, w[order[2]])
    s2 = -s1 * s3 if odd else s1 * s3
    return (_row(order[0], s1), _row(order[1], s2), _row(order[2], s3))


def _row(axis: int, sign: float) -> Vec3:
    return (
        sign if axis == 0 else 0.0,
        sign if axis == 1 else 0.0,
        sign if axis == 2 else 0.0,
    )


def _moment(axis: Vec3, inertia: Vec3) -> float:
    return sum(abs(x) * moment for x, moment in zip(axis, inertia, strict=True))


def _transposed(m: Mat3) -> Mat3:
    (a, b, c), (d, e, f), (g, h, i) = m
    return ((a, d, g), (b, e, h), (c, f, i))


def _about_z(angle: float) -> Quat:
    return (cos(0.5 * angle), 0.0, 0.0, sin(0.5 * angle))


def _quaternion(m: Mat3) -> Quat:
    """Return the quaternion of a rotation matrix: the largest component comes from the diagonal."""
    (a, b, c), (d, e, f), (g, h, i) = m
    squares = (1.0 + a + e + i, 1.0 + a - e - i, 1.0 - a + e - i, 1.0 - a - e + i)
    largest = max(range(4), key=lambda k: squares[k])
    rows: tuple[Quat, ...] = (
        (squares[0], h - f, c - g, d - b),
        (h - f, squares[1], b + d, c + g),
        (c - g, b + d, squares[2], f + h),
        (d - b, c + g, f + h, squares[3]),
    )
    return normalise(rows[largest])
