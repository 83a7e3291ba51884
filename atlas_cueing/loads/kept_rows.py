"""Traction and torque that a motion has to keep, as rows A x <= b of its accelerations.

With n_f a hundredth of the least normal force of a wheel at rest, and wheels as in `balance`,

    |F_i| <= (mu_i / margin) (n_i - n_f)        |r_i F_i + J_i w_i'| + b_i |w_i| + tau_c <= tau

and every support pushes. Drive and normal forces are linear in moment and force (3), (7),

    F_d = D M        n = n_0 + N V^T D M - N F

and these in alpha = J w' and the stage's a (1), (2). Each row is scaled by what it has at rest.

In ANY orientation, with the principal moments of inertia within d of Ibar,

    M = Ibar alpha + e      |e| <= d (|alpha| + |Omega|^2) + m |c| |a - g|
    F = m (a - g) + f       |f| <= m |c| (|alpha| + |Omega|^2)
"""

# mypyc: runs every tick

from collections.abc import Sequence
from math import inf, sqrt
from typing import Final

from ..rotation import (
    ZERO,
    Mat3,
    Quat,
    Vec3,
    add,
    apply,
    conjugate,
    cross,
    dot,
    norm,
    rotate,
    scale,
)
from ..signals import STANDARD_GRAVITY
from .tick_loads import WheelLoads

_FLOOR: Final = 0.01  # n_f, of the smallest normal force at rest (assumed)
_ROUNDING: Final = 1e-9  # of a torque, left to rounding


class _Row:
    """g . M + h . F + own . w' + drag . |w| <= room, with its form for any orientation."""

    def __init__(
        self, g: Vec3, h: Vec3, own: Vec3, drag: Vec3, room: float, wheels: Vec3, mass: float
    ) -> None:
        """wheels: what Ibar alpha adds to the row, by wheel acceleration."""
        self.g, self.h, self.own, self.drag, self.room = g, h, own, drag, room
        self.wheels = add(wheels, own)
        self.stage = scale(mass, h)
        self.weight = mass * STANDARD_GRAVITY * h[2]
        self.by_moment, self.by_force = norm(g), norm(h)


class KeptRows:
    """The rows of one platform with three wheels; `LoadModel.kept_rows` makes it."""

    def __init__(
        self,
        *,
        loads: WheelLoads,
        inertia_middle: float,
        inertia_spread: float,
        sphere_from_wheels: Mat3,
        normal_from_moment: Mat3,
        grip: Vec3,
        standing: Vec3,
        torque: float,
        supports: Sequence[tuple[Vec3, Vec3, float]],
    ) -> None:
        """Keep the constants.

        Args:
            loads: those of a tick.
            inertia_middle: Ibar, kg m^2.
            inertia_spread: d, kg m^2.
            sphere_from_wheels: J.
            normal_from_moment: N V^T D, 1/m.
            grip: friction over margin of each wheel.
            standing: normal forces upright at rest, with no drive force, N.
            torque: largest at an axle, N m, or infinite.
            supports: of each: N V^T D's row, N's row, and its force without any need, N.
        """
        self._loads, self._J = loads, sphere_from_wheels
        self._middle, self._spread = inertia_middle, inertia_spread
        self._lever = loads.mass * norm(loads.com)  # m |c|
        self._grip, self._standing = grip, standing
        self._floor = _FLOOR * max(min(standing), 0.0)
        self._normal_from_moment = normal_from_moment
        self._torque = torque * (1.0 - _ROUNDING)
        self._table = [*self._traction(), *self._drives(), *self._supports(supports)]
        self._size = _products(sphere_from_wheels)

    @property
    def sphere_from_wheels(self) -> Mat3:
        """J: the sphere's rate (rad/s, W) from the wheels' speeds."""
        return self._J

    def excess(
        self, q_WS: Quat, wheel_speed: Vec3, wheel_acceleration: Vec3, a_WS_W: Vec3
    ) -> float:
        """Give the largest A x - b of one state, scaled; above 0 it asks too much."""
        w, alpha = apply(self._J, wheel_speed), apply(self._J, wheel_acceleration)
        M, F = self._loads.wrench(q_WS, w, alpha, a_WS_W)
        most = -inf
        for row in self._table:
            g, h, own, drag = row.g, row.h, row.own, row.drag
            asked = (
                g[0] * M[0] + g[1] * M[1] + g[2] * M[2] + h[0] * F[0] + h[1] * F[1] + h[2] * F[2]
            ) - row.room
            asked += dot(own, wheel_acceleration) + _drag(drag, wheel_speed)
            if not asked <= most:
                most = asked
        return most

    def rows(self, q_WS: Quat, wheel_speed: Vec3, a_WS_W: Vec3) -> list[tuple[Vec3, float]]:
        """Give (row, bound) in the accelerations of the wheels alone, for this stage's."""
        w, back = apply(self._J, wheel_speed), conjugate(q_WS)
        m, c = self._loads.mass, self._loads.com
        M, F = self._loads.wrench(q_WS, w, ZERO, a_WS_W)
        rows: list[tuple[Vec3, float]] = []
        for row in self._table:
            g, h = rotate(back, row.g), rotate(back, row.h)
            by_alpha = add(apply(self._loads.inertia, g), scale(m, cross(c, h)))
            by_wheels = add(_transposed(self._J, rotate(q_WS, by_alpha)), row.own)
            bound = row.room - dot(row.g, M) - dot(row.h, F) - _drag(row.drag, wheel_speed)
            rows.append((by_wheels, bound))
        return rows

    def largest_excess(
        self, lowest: Vec3, highest: Vec3, speed: Vec3, a_lowest: Vec3, a_highest: Vec3
    ) -> float:
        """Give a bound on the excess in any orientation, for all accelerations between.

        speed: the largest of each wheel either way, rad/s.
        """
        turning = sqrt(self._square(_largest(lowest, highest))) + self._square(speed)
        a = _largest(a_lowest, a_highest)
        up = max(abs(a_lowest[2] + STANDARD_GRAVITY), abs(a_highest[2] + STANDARD_GRAVITY))
        moment = self._spread * turning + self._lever * norm((a[0], a[1], up))
        force = self._lever * turning
        most = -inf
        for row in self._table:
            asked = row.by_moment * moment + row.by_force * force + row.weight - row.room
            asked += _highest(row.wheels, lowest, highest) + _highest(
                row.stage, a_lowest, a_highest
            )
            asked += _drag(row.drag, speed)
            if not asked <= most:
                most = asked
        return most

    def shortfall(self, q_WS: Quat) -> str:
        """Say in numbers what a rest in this orientation asks too much; empty if nothing."""
        if self.excess(q_WS, ZERO, ZERO, ZERO) <= 0.0:
            return ""
        M, F = self._loads.wrench(q_WS, ZERO, ZERO, ZERO)
        drive = apply(self._loads.drive_from_moment, M)
        n, pushed = apply(self._normal_from_moment, M), apply(self._loads.normal_from_push, F)
        lines = []
        for i in range(3):
            normal = self._loads.normal_at_rest[i] + n[i] - pushed[i]
            allowed = self._grip[i] * (normal - self._floor)
            torque = self._loads.radius[i] * drive[i]
            if not abs(drive[i]) <= allowed:
                lines.append(
                    f"wheel.{i}: drive force {drive[i]:.6g} N, allowed: at most {allowed:.6g} N"
                    f" ({self._grip[i]:.3g} of its normal force, {normal:.6g} N)"
                )
            if not abs(torque) <= self._torque:
                lines.append(
                    f"wheel.{i}: torque {torque:.6g} N m, allowed: at most {self._torque:.6g} N m"
                )
        return "; ".join(lines) or "a support does not touch"

    def _traction(self) -> list[_Row]:
        """Rows +-F_i - k_i n_i <= -k_i n_f."""
        rows = []
        for i in range(3):
            k, D = self._grip[i], self._loads.drive_from_moment[i]
            P, N = self._normal_from_moment[i], self._loads.normal_from_push[i]
            room = k * (self._loads.normal_at_rest[i] - self._floor)
            size = 1.0 / max(k * self._standing[i], 1e-9)
            for sign in (1.0, -1.0):
                g = add(scale(sign * size, D), scale(-k * size, P))
                rows.append(self._row(g, scale(k * size, N), ZERO, ZERO, room * size))
        return rows

    def _drives(self) -> list[_Row]:
        """Rows +-(r_i F_i + J_i w_i') + b_i |w_i| <= tau - tau_c."""
        if self._torque == inf:
            return []
        rows, loads = [], self._loads
        for i in range(3):
            size = 1.0 / self._torque
            room = (self._torque - loads.coulomb[i]) * size
            for sign in (1.0, -1.0):
                g = scale(sign * size * loads.radius[i], loads.drive_from_moment[i])
                own = _unit(i, sign * size * loads.wheel_inertia[i])
                rows.append(self._row(g, ZERO, own, _unit(i, size * loads.viscous[i]), room))
        return rows

    def _supports(self, supports: Sequence[tuple[Vec3, Vec3, float]]) -> list[_Row]:
        """Rows -n_j <= 0."""
        size = 1.0 / max(*self._standing, 1e-9)
        return [
            self._row(scale(-size, P), scale(size, N), ZERO, ZERO, size * alone)
            for P, N, alone in supports
        ]

    def _row(self, g: Vec3, h: Vec3, own: Vec3, drag: Vec3, room: float) -> _Row:
        wheels = scale(self._middle, _transposed(self._J, g))
        return _Row(g, h, own, drag, room, wheels, self._loads.mass)

    def _square(self, x: Vec3) -> float:
        """Give a bound on |J x|^2 for wheels that turn at most x either way."""
        a, b, c, ab, ac, bc = self._size
        return (
            x[0] * (a * x[0] + ab * x[1] + ac * x[2])
            + x[1] * (b * x[1] + bc * x[2])
            + c * x[2] * x[2]
        )


def _products(J: Mat3) -> tuple[float, float, float, float, float, float]:
    """Give (J^T J)_11, _22, _33 and twice the sizes of _12, _13, _23."""
    x, y, z = (tuple(row[i] for row in J) for i in range(3))
    pairs = ((x, x), (y, y), (z, z), (x, y), (x, z), (y, z))
    a, b, c, ab, ac, bc = (
        sum(p * q for p, q in zip(one, other, strict=True)) for one, other in pairs
    )
    return a, b, c, 2.0 * abs(ab), 2.0 * abs(ac), 2.0 * abs(bc)


def _transposed(m: Mat3, v: Vec3) -> Vec3:
    """Give m^T v."""
    (a, b, c), (d, e, f), (g, h, i) = m
    x, y, z = v
    return (a * x + d * y + g * z, b * x + e * y + h * z, c * x + f * y + i * z)


def _unit(i: int, x: float) -> Vec3:
    return (x if i == 0 else 0.0, x if i == 1 else 0.0, x if i == 2 else 0.0)


def _drag(drag: Vec3, w: Vec3) -> float:
    return drag[0] * abs(w[0]) + drag[1] * abs(w[1]) + drag[2] * abs(w[2])


def _largest(low: Vec3, high: Vec3) -> Vec3:
    return (
        max(abs(low[0]), abs(high[0])),
        max(abs(low[1]), abs(high[1])),
        max(abs(low[2]), abs(high[2])),
    )


def _highest(c: Vec3, low: Vec3, high: Vec3) -> float:
    """Give the largest c . x for low <= x <= high."""
    return (
        c[0] * (high[0] if c[0] > 0.0 else low[0])
        + c[1] * (high[1] if c[1] > 0.0 else low[1])
        + c[2] * (high[2] if c[2] > 0.0 else low[2])
    )
