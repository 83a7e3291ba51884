"""The plan of a whole flight: rotation, stage, and then both at once."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ... import rotation
from ...rotation import Quat, Vec3, multiply, shortest_arc
from ...rotations import Array, cross, rotate, rotate_back
from ...signals import STANDARD_GRAVITY, StageLimits, VehicleState
from ..cabin import upright
from .inertial import Inertial, inertial, integrate_rates
from .joint_plan import plan_jointly
from .planned_cues import PlannedCues
from .preview_parameters import PreviewParameters
from .spline import Spline
from .stage_plan import plan_stage
from .tilt_plan import Up, UpPlanner, sampled

_UP: Vec3 = (0.0, 0.0, 1.0)
_GRAVITY_W = np.array([0.0, 0.0, -STANDARD_GRAVITY])


def plan_motion(
    states: Sequence[VehicleState],
    parameters: PreviewParameters,
    limits: StageLimits,
    head_S: Vec3,
    dt: float,
) -> PlannedCues:
    """Plan the platform's motion for all states of a flight, dt s apart.

    head_S: the rider's head from the sphere's centre, m, in S.

    First the rotation for the whole force, at its global best, and the stage for what it leaves;
    then both at once from there, `rounds` times. The cheapest counts. Raises InputError when there
    is no plan, or no solver.
    """
    spline = Spline(len(states), dt, parameters.planning_rate)
    problem = _Problem(
        spline, inertial(states, dt), upright(states[0].q_NB), parameters, np.array(head_S), dt
    )
    up = UpPlanner(spline, parameters).plan(problem.flight.f_A)
    path = problem.path(up)
    plans = [problem.plan(path, plan_stage(spline, path.lacking_W, limits))]
    for _ in range(parameters.rounds):
        up, stage = plan_jointly(
            spline,
            up,
            path.q_WA,
            problem.flight.f_A - rotate_back(path.q_WA, path.turning_W),
            parameters,
            limits,
        )
        path = problem.path(up)
        plans.append(problem.plan(path, stage))
    return min(plans, key=lambda plan: plan.cost).cues


@dataclass(frozen=True, slots=True)
class _CabinPath:
    """The rotation at each of n ticks.

    up: W's up in A; q_WA (n, 4): A in W; w_W (n, 3): the cabin's rate, rad/s; turning_W (n, 3): the
    acceleration of the head by turning, m/s^2; lacking_W (n, 3): what it still lacks.
    """

    up: Up
    q_WA: Array
    w_W: Array
    turning_W: Array
    lacking_W: Array


@dataclass(frozen=True, slots=True)
class _Plan:
    """A whole plan and its mean cost."""

    cues: PlannedCues
    cost: float


@dataclass(frozen=True, slots=True)
class _Problem:
    """What all rounds have in common.

    start: the cabin's attitude before its turn to the first force.
    """

    spline: Spline
    flight: Inertial
    start: Quat
    parameters: PreviewParameters
    head_S: Array
    dt: float

    def path(self, points: Array) -> _CabinPath:
        """Give the rotation that control points (points, 3) of W's up make."""
        up = sampled(self.spline, points)
        q_WA = self._orientations(up)
        w_W = rotate(q_WA, self.flight.w_A + up.rate)
        turning_W = self._turning(q_WA, w_W)
        return _CabinPath(
            up, q_WA, w_W, turning_W, rotate(q_WA, self.flight.f_A) + _GRAVITY_W - turning_W
        )

    def plan(self, path: _CabinPath, stage: Array) -> _Plan:
        """Join the rotation and the stage of these control points (points, 3); gives the plan."""
        spline = self.spline
        p_W, v_W, a_W = (
            np.asarray(matrix @ stage) for matrix in (spline.value, spline.slope, spline.curvature)
        )
        force, rate = (
            np.sum((path.lacking_W - a_W) ** 2, axis=1),
            np.sum(path.up.rate**2, axis=1),
        )
        cost = np.mean(force / self.parameters.force_unit**2 + rate / self.parameters.rate_unit**2)
        q_WS = _product(path.q_WA, self.flight.q_AS)
        return _Plan(PlannedCues(self.flight.time, q_WS, path.w_W, p_W, v_W, a_W), float(cost))

    def _orientations(self, up: Up) -> Array:
        """Give q_WA (n, 4): the first attitude, turned to W's up, and on from there.

        It is turned the shortest way.
        """
        x, y, z = up.direction[0].tolist()
        first = multiply(shortest_arc(rotation.rotate(self.start, (x, y, z)), _UP), self.start)
        return np.array(
            integrate_rates(first, [(a, b, c) for a, b, c in up.rate.tolist()], self.dt)
        )

    def _turning(self, q_WA: Array, w_W: Array) -> Array:
        """Acceleration of the head (W) that the sphere's turning makes."""
        if not np.any(self.head_S) or len(w_W) < 2:
            return np.zeros_like(w_W)
        r_W = rotate(_product(q_WA, self.flight.q_AS), np.broadcast_to(self.head_S, w_W.shape))
        return np.asarray(
            cross(np.gradient(w_W, self.dt, axis=0), r_W) + cross(w_W, cross(w_W, r_W))
        )


def _product(p: Array, q: Array) -> Array:
    """Hamilton products, row by row.

    They are those of `rotations.multiply` but for the last bit, on which the plans depend.
    """
    w = p[:, :1] * q[:, :1] - np.sum(p[:, 1:] * q[:, 1:], axis=1, keepdims=True)
    return np.hstack([w, p[:, :1] * q[:, 1:] + q[:, :1] * p[:, 1:] + cross(p[:, 1:], q[:, 1:])])
