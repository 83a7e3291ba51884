"""Drive forces of more than three wheels that use the least share of friction.

Least squares (3) spreads the moment evenly, but a wheel with little normal force slips first.
Of all F_d with R B^T F_d = M the one with the least largest use is wanted. The normal forces
depend on F_d too: n = n_a + G F_d is linear (7), so the use is a ratio of linear functions, and

    t(s) = min over F_d of max_i (|F_i| - s mu_i n_i)

is a linear program whose root in s is the least use (Dinkelbach, Management Science 13(7), 1967).
"""

import numpy as np

from ..rotations import Array
from .model import LoadModel
from .normal_forces import bilateral_forces

_MOST_ROUNDS = 30
_SETTLED = 1e-12  # relative change of the use


def least_use_drive(model: LoadModel, moment_W: Array, force_W: Array) -> Array:
    """Drive forces (n, N), N, of the least largest traction use; the contacts are bilateral.

    moment_W (n, 3), N m, and force_W (n, 3), N: as `balance.required_wrench` gives them. Where no
    split keeps all wheels pushing, the least-squares split is given. It takes some milliseconds a
    state: for whole runs, not for a loop.
    """
    even = moment_W @ model.drive_from_moment.T
    if len(model.wheels) == 3:
        return even
    return np.array([_best(model, *row) for row in zip(moment_W, force_W, even, strict=True)])


def _best(model: LoadModel, M: Array, F: Array, even: Array) -> Array:
    count = len(model.wheels)
    fixed = bilateral_forces(model, (F - model.preload_W)[None])[0, :count]
    by_drive = model.normal_from_need[:count] @ model.V.T  # dn/dF_d: need has -V^T F_d
    drive, use = even, _largest_use(model, even, fixed, by_drive)
    if not np.isfinite(use):
        drive, use = even, 1e3  # begin with a split in which every wheel pushes, if there is one
    for _ in range(_MOST_ROUNDS):
        found = _program(model, M, fixed, by_drive, use)
        better = _largest_use(model, found, fixed, by_drive)
        if not better < use * (1.0 - _SETTLED):
            break
        drive, use = found, better
    return drive


def _program(model: LoadModel, M: Array, fixed: Array, by_drive: Array, use: float) -> Array:
    """Minimise t over (F_d, t): +-F_i - use mu_i (fixed + by_drive F_d)_i <= t, R B^T F_d = M."""
    from scipy.optimize import linprog  # takes a second to import

    count = len(model.wheels)
    grip = use * model.friction
    rows = [
        np.hstack([sign * np.eye(count) - grip[:, None] * by_drive, -np.ones((count, 1))])
        for sign in (1.0, -1.0)
    ]
    scale = max(float(np.abs(fixed).max()), 1.0)  # N: the solver's tolerances are absolute
    moment = np.hstack([model.sphere_radius * model.B.T, np.zeros((3, 1))])
    solved = linprog(
        np.array([0.0] * count + [1.0]),
        A_ub=np.vstack(rows),
        b_ub=np.tile(grip * fixed, 2) / scale,
        A_eq=moment,
        b_eq=M / scale,
        bounds=[(None, None)] * (count + 1),
    )
    drive: Array = scale * np.asarray(solved.x[:count] if solved.x is not None else np.zeros(count))
    missing = M - model.sphere_radius * model.B.T @ drive
    exact: Array = drive + model.drive_from_moment @ missing
    return exact


def _largest_use(model: LoadModel, drive: Array, fixed: Array, by_drive: Array) -> float:
    normal = fixed + by_drive @ drive
    if np.any(normal <= 0.0):
        return float("inf")
    return float(np.max(np.abs(drive) / (model.friction * normal)))
