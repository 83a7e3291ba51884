"""Rotation and stage at once, near a plan that was made for one after the other.

With A held in W as the plan has it, the force that a rider feels, seen in A, is linear in W's up m
and in the stage's acceleration a: g m + R_AW a. Its squared error and all bounds make one convex
programme, in which m moves on the planes that touch the sphere at the plan's own path. The stage
can then begin a push that the cabin is going to take over.
"""

import numpy as np
from scipy.sparse import block_diag, csc_array, diags_array, hstack, kron

from ...rotations import Array, rotate_back
from ...signals import STANDARD_GRAVITY, StageLimits
from .preview_parameters import PreviewParameters
from .solver import Bounds, minimise
from .spline import Spline
from .stage_plan import acceleration, stage_bounds
from .tilt_plan import turn_bounds, turn_cost


def plan_jointly(
    spline: Spline,
    up: Array,
    q_WA: Array,
    f_A: Array,
    parameters: PreviewParameters,
    limits: StageLimits,
) -> tuple[Array, Array]:
    """Plan W's up in A and the stage in W; gives control points of each, (points, 3).

    Args:
        spline: the curve that the control points shape.
        up: control points (points, 3) of W's up so far.
        q_WA: A in W on that path, at each tick (ticks, 4).
        f_A: the specific force that gravity and the stage should give (ticks, 3), m/s^2, in A.
        parameters: of the method.
        limits: of the stage.

    Raises InputError when the solver fails.
    """
    n, each = spline.points, 3 * spline.points - 3
    total = 3 * n + 3 * each
    bounds = (turn_bounds(spline, parameters) + _touching(up)).among(0, total)
    for axis in range(3):
        bounds += stage_bounds(spline, limits, axis).among(3 * n + axis * each, total)
    felt = _felt(spline, q_WA)
    weight = 2.0 / (parameters.force_unit**2 * spline.ticks)
    extra = block_diag([turn_cost(spline, parameters), csc_array((3 * each, 3 * each))])
    x = minimise(
        csc_array(weight * (felt.T @ felt) + extra), -weight * (felt.T @ f_A.ravel()), bounds
    )
    stage = [x[3 * n + axis * each :][:n] for axis in range(3)]
    return x[: 3 * n].reshape(-1, 3), np.stack(stage, axis=1)


def _touching(up: Array) -> Bounds:
    """Bound each control point to the plane that touches the sphere where it was."""
    length = np.linalg.norm(up, axis=1)
    rows = np.repeat(np.arange(len(up)), 3)
    bounds = Bounds()
    bounds.equal(
        csc_array(((up / length[:, None]).ravel(), (rows, np.arange(3 * len(up))))), length
    )
    return bounds


def _felt(spline: Spline, q_WA: Array) -> csc_array:
    """Give the matrix from all unknowns to the force (m/s^2, A) at the ticks, three rows each."""
    blocks = [kron(spline.value, STANDARD_GRAVITY * np.eye(3))]
    push = kron(acceleration(spline), np.ones((3, 1)))
    for axis in np.eye(3):
        along_A = rotate_back(q_WA, np.broadcast_to(axis, (spline.ticks, 3)))
        blocks.append(diags_array(along_A.ravel()) @ push)
    return csc_array(hstack(blocks))
