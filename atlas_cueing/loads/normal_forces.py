"""Normal forces of wheels and supports (equation 7).

What the contacts push the sphere with has to close the balance of forces:

    -sum n_j u_j = F - V^T F_d - preloads = need                                               (7)

With three wheels and nothing else it is determinate: n = -U^-T need. Otherwise each contact is a
spring, n_j = n0_j + k_j u_j . d, for the small displacement d of the sphere:

    K d = -(need + sum n0_j u_j),   K = sum k_j u_j u_j^T

Three wheels alone give the same n for any stiffness. A contact cannot pull: n_j = max(0, ...).
Then d is where the convex potential

    Phi(d) = sum max(0, n0_j + k_j u_j . d)^2 / (2 k_j) + need . d

is least (the minimum of complementary energy), which Newton steps with a line search find in a
few steps, Phi being piecewise quadratic. Where they do not, as when no more than two contacts push
on the way, `exact_push` does. Where Phi has no least value, no push of the contacts balances
`need`: the sphere lifts off. The bilateral forces are given then, negative at the contacts that
would have to pull.
"""

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array
from .exact_push import pushing_forces
from .model import LARGEST_CONDITION_NUMBER, LoadModel

_MOST_STEPS = 60
_MOST_HALVINGS = 40
_DECREASE = 1e-4  # least share of the decrease that the slope promises (Armijo)
_CLOSED = 1e-9  # of the force to balance: residual of the equilibrium


def bilateral_forces(model: LoadModel, need_W: Array) -> Array:
    """Normal forces (n, N + M), N, as if contacts could pull; `need_W` (n, 3), N."""
    offset = need_W + model.unloaded @ model.all_contacts
    forces: Array = model.unloaded - offset @ model.normal_from_need.T
    return forces


def normal_forces(model: LoadModel, need_W: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Normal forces (n, N + M), N, and whether all contacts push in the bilateral solution (n,).

    need_W: what the normal forces have to give the sphere, with its sign turned (7), (n, 3), N.
    """
    forces = bilateral_forces(model, need_W)
    pushing = np.all(forces > 0.0, axis=1)
    if len(model.all_contacts) > 3:
        for k in np.flatnonzero(~pushing).tolist():
            opened = _with_open_contacts(model, need_W[k])
            if opened is None:
                opened = pushing_forces(model, need_W[k])
            forces[k] = forces[k] if opened is None else opened
    return forces, pushing


def _with_open_contacts(model: LoadModel, need: Array) -> Array | None:
    """Normal forces (N + M,) of which none is negative, or None where Newton's steps find none."""
    d = np.zeros(3)
    scale = float(np.abs(need).max() + np.abs(model.unloaded).max() + 1e-300)
    for _ in range(_MOST_STEPS):
        forces = _pushes(model, d)
        slope = forces @ model.all_contacts + need
        if np.abs(slope).max() <= _CLOSED * scale:
            return forces
        step = _newton_step(model, forces > 0.0, slope)
        if step is None:
            return None
        d = d + _shortened(model, need, d, step, float(slope @ step))
    return None


def _pushes(model: LoadModel, d: Array) -> Array:
    stretched: Array = model.unloaded + model.stiffness * (model.all_contacts @ d)
    return np.maximum(stretched, 0.0)


def _potential(model: LoadModel, need: Array, d: Array) -> float:
    return float(0.5 * np.sum(_pushes(model, d) ** 2 / model.stiffness) + need @ d)


def _newton_step(model: LoadModel, closed: NDArray[np.bool_], slope: Array) -> Array | None:
    """The step to the least value of the present quadratic piece.

    Where too few contacts are closed for one, the springs of all of them make it safe.
    """
    weights = np.where(closed, model.stiffness, 0.0)
    K = (model.all_contacts * weights[:, None]).T @ model.all_contacts
    if np.linalg.cond(K) > LARGEST_CONDITION_NUMBER:
        K = (model.all_contacts * model.stiffness[:, None]).T @ model.all_contacts
    step: Array = np.linalg.solve(K, -slope).astype(np.float64)
    return step if np.all(np.isfinite(step)) else None


def _shortened(model: LoadModel, need: Array, d: Array, step: Array, slope: float) -> Array:
    """The first of step, step / 2, ... along which the potential falls as its slope promises."""
    before = _potential(model, need, d)
    for k in range(_MOST_HALVINGS):
        if _potential(model, need, d + step) <= before + _DECREASE * 0.5**k * slope:
            break
        step = 0.5 * step
    return step
