"""The plan of one stage axis as a quadratic program.

Position p, velocity v and acceleration a from now to the horizon, with a jerk that is constant over
each of n blocks. The unknowns are the accelerations at the ends of all blocks but the last; there a
= 0, and v = 0 is the one equation, so that every plan ends at a standstill and is feasible for
ever. The plan minimises the integral of the square of

    a - (d - 2 omega v - omega^2 p)

with d the demand, fading. Without limits that is the critically damped onset filter; it is also
what minimises the integral of (a - c d)^2 + 2 omega^2 v^2 + omega^4 p^2, the rider's force error
and a cost of effort, for a demand that is known to fade: c takes in how long it will last
(Kwakernaak & Sivan, Linear Optimal Control Systems, 1972, section 3.3: complete the square).

Over a block v is a parabola and p a cubic. Both lie within the hull of their Bezier control points,
so bounds on these hold between the nodes too. A first block within a block of the plan before has
its control points within that one's hull, so that replacing a plan never gives up a limit.

Where the optimum without limits keeps them all, it is the plan (`mpc_unconstrained`); otherwise
daqp searches for it.
"""

# mypyc: runs every tick

from collections.abc import Sequence
from functools import lru_cache
from typing import TypeAlias

import daqp
import numpy as np

from ...rotations import Array
from .mpc_unconstrained import Plan, State, UnlimitedPlan

# travel m, speed m/s, acceleration m/s^2, jerk m/s^3
AxisLimits: TypeAlias = tuple[float, float, float, float]

LIMIT_SHARE = 0.999
"""Share of each limit that is planned with (assumed: the solver's error, some 1e-6, is far below
the rest)."""

_ITERATIONS = 200  # of the active set, where ten are many: bounds the time of a solve (assumed)
_SOLVED = 1  # daqp's exit flag for an optimum
_EQUATION = 5  # daqp's type of an equality
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact for the square of a cubic


class MpcProblem:
    """Finds the jerks of the best plan of one axis.

    Of the unknowns x (m,) the cost is x hessian x / 2 + x gradient (p, v, a, d), with `hessian` (m,
    m) and `gradient` (m, 4). Limits are |(x, rows x) + offset (p, v, a)| <= bound, with `rows` (c,
    m), `offset` (m + c, 3), `bound` (m + c,); the last row is the equation.
    """

    def __init__(
        self, durations: Sequence[float], omega: float, fade: float, limits: AxisLimits
    ) -> None:
        """Set up the problem of blocks with these durations (s), at least two.

        omega: natural frequency of the filter followed, rad/s; fade: time constant with which the
        demand goes on, s.

        Raises ValueError when the solver does not take the problem.
        """
        cost, bounded, bound, self.unlimited = _prepared(tuple(durations), omega, fade, limits)
        self.hessian, self.gradient = (
            np.ascontiguousarray(cost[4:, 4:]),
            np.ascontiguousarray(cost[4:, :4]),
        )
        unknowns = len(durations) - 1
        self.rows, self.offset = (
            np.ascontiguousarray(bounded[unknowns:, 4:]),
            np.ascontiguousarray(bounded[:, :3]),
        )
        self.bound, self._lower, self._bounds = bound, -bound, len(bound)
        # what both take from (p, v, a, d), in one product
        self._from_now = np.vstack([bounded[:, :4], self.gradient])
        self._jerk_from_a = [1.0 / duration for duration in durations]
        kinds = np.zeros(len(bound), dtype=np.int32)
        kinds[-1] = _EQUATION
        self._solver = daqp.Model()
        taken, _ = self._solver.setup(
            self.hessian, np.zeros(unknowns), self.rows, bound.copy(), self._lower.copy(), kinds
        )
        if taken < 0:
            raise ValueError(
                f"a stage problem that the solver takes; got limits {limits}, omega {omega} (exit"
                f" flag {taken})"
            )
        self._solver.settings = {"iter_limit": _ITERATIONS}

    def solve(self, p: float, v: float, a: float, demand: float) -> Plan | None:
        """Find the plan from state p, v, a and the demand now (m/s^2); None when there is none."""
        state = (p, v, a, demand)
        if self.unlimited.is_free(state):
            return self.unlimited.plan(state)
        return self._within_limits(state)

    def _within_limits(self, state: State) -> Plan | None:
        """Find the plan by daqp, which takes some ten times as long as the unconstrained one."""
        of_now = self._from_now @ np.array(state)
        offset, linear = of_now[: self._bounds], of_now[self._bounds :]
        if (
            self._solver.update(f=linear, bupper=self.bound - offset, blower=self._lower - offset)
            < 0
        ):
            return None
        x, _, flag, _ = self._solver.solve()
        if flag != _SOLVED:
            return None
        ends = [state[2], *x.tolist(), 0.0]
        jerks = [
            (end - begin) * factor
            for begin, end, factor in zip(ends, ends[1:], self._jerk_from_a, strict=False)
        ]
        return Plan([(jerk, 0.0, 0.0, 0.0) for jerk in jerks], (1.0, 0.0, 0.0, 0.0))


# A form is the row of factors that gives a quantity from (p, v, a, d, x): the state now, the demand
# now, the unknowns.


@lru_cache(maxsize=16)  # 3 ms, which a real-time loop that begins anew does not have
def _prepared(
    durations: tuple[float, ...], omega: float, fade: float, limits: AxisLimits
) -> tuple[Array, Array, Array, UnlimitedPlan]:
    """Make the matrix of the cost, the forms of all that is bounded, their bounds, and their plan.

    The arrays cannot be written to.
    """
    nodes = _nodes(durations)
    cost, (bounded, bound) = _cost(durations, nodes, omega, fade), _limits(durations, nodes, limits)
    for array in (cost, bounded, bound):
        array.flags.writeable = False
    return cost, bounded, bound, UnlimitedPlan(durations, cost, bounded, bound)


def _nodes(durations: Sequence[float]) -> tuple[Array, Array, Array]:
    """Give the forms (n + 1, 4 + m) of p, v and a at the ends of the blocks; the first is now."""
    blocks = len(durations)
    p, v, a = np.zeros((3, blocks + 1, blocks + 3))
    p[0, 0] = v[0, 1] = a[0, 2] = 1.0
    a[1:-1, 4:] = np.eye(blocks - 1)
    for k, h in enumerate(durations):
        v[k + 1] = v[k] + h / 2.0 * (a[k] + a[k + 1])
        p[k + 1] = p[k] + h * v[k] + h * h / 6.0 * (2.0 * a[k] + a[k + 1])
    return p, v, a


def _cost(
    durations: Sequence[float], nodes: tuple[Array, Array, Array], omega: float, fade: float
) -> Array:
    """Give the matrix C (4 + m, 4 + m) of the cost y C y / 2, y = (p, v, a, d, x)."""
    p, v, a = nodes
    cost, begin = np.zeros((p.shape[1], p.shape[1])), 0.0
    for k, h in enumerate(durations):
        for point, weight in zip(_POINTS, _WEIGHTS, strict=True):
            t = 0.5 * h * (point + 1.0)
            jerk = (a[k + 1] - a[k]) / h
            a_t, v_t = a[k] + t * jerk, v[k] + t * (a[k] + t * jerk / 2.0)
            p_t = p[k] + t * (v[k] + t * (a[k] / 2.0 + t * jerk / 6.0))
            error = a_t + 2.0 * omega * v_t + omega * omega * p_t
            error[3] -= np.exp(-(begin + t) / fade)
            cost += weight * h * np.outer(error, error)
        begin += h
    return cost


def _limits(
    durations: Sequence[float], nodes: tuple[Array, Array, Array], limits: AxisLimits
) -> tuple[Array, Array]:
    """Give the forms of all that is bounded, and their bounds.

    These are the unknowns, the jerks, v and p by control points, and v = 0 at the end. Control
    points that the state alone decides are left out.
    """
    p, v, a = nodes
    h = np.asarray(durations)[:, None]
    travel, speed, acceleration, jerk = (LIMIT_SHARE * limit for limit in limits)
    kept = [
        (a[1:-1], acceleration),
        ((a[1:] - a[:-1]) / h, jerk),
        ((v[:-1] + h / 2.0 * a[:-1])[1:], speed),
        (v[1:-1], speed),
        ((p[:-1] + h / 3.0 * v[:-1])[1:], travel),
        ((p[:-1] + 2.0 * h / 3.0 * v[:-1] + h * h / 6.0 * a[:-1])[1:], travel),
        (p[1:], travel),
        (v[-1:], 0.0),
    ]
    return np.vstack([forms for forms, _ in kept]), np.concatenate(
        [np.full(len(forms), bound) for forms, bound in kept]
    )
