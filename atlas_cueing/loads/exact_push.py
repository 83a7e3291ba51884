"""Normal forces where Newton's steps do not end: a search that goes to the end of each piece.

The potential Phi of `normal_forces` is convex and quadratic in pieces: in each one the same
contacts push. Where fewer than three independent ones do, Phi is straight along the directions d
that none of them resists, and a Newton step does not exist. So a step is either down such a
direction, or to the least value of the piece; and it goes to the least value of Phi along it, which
is exact, as Phi' is straight between the places where a contact closes or opens. A direction along
which Phi falls without end proves that no push of the contacts balances `need` (Farkas' lemma).
"""

import numpy as np

from ..rotations import Array
from .model import LoadModel

_STEPS_A_CONTACT = 40  # some ten are needed in all; more only where rounding decides
_FREE = 1e-11  # of the stiffness of all contacts: what resists a direction less does not at all
_BALANCED = 1e-9  # of the force to balance, as in `normal_forces`
_NO_RISE = 1e-13  # of the stiffness along the step: Phi' does not rise any more


def pushing_forces(model: LoadModel, need: Array) -> Array | None:
    """Normal forces (N + M,), N, none negative, that balance `need` (3,), N, in W (7).

    They are those of the least complementary energy. None where no push does.
    """
    contacts, scale = model.all_contacts, float(np.abs(need).max() + np.abs(model.unloaded).max())
    if scale == 0.0:
        return np.zeros(len(contacts))
    k = model.stiffness / model.stiffness.max()
    rest, wanted, d = model.unloaded / scale, need / scale, np.zeros(3)
    for _ in range(_STEPS_A_CONTACT * len(contacts)):
        stretched = rest + k * (contacts @ d)
        slope = np.maximum(stretched, 0.0) @ contacts + wanted
        if np.abs(slope).max() <= _BALANCED:
            forces: Array = scale * np.maximum(stretched, 0.0)
            return forces
        step = _downhill(contacts, np.where(stretched > 0.0, k, 0.0), slope)
        move = contacts @ step
        length = _least_along(stretched, k * move, move, float(wanted @ step))
        if length is None:
            return None
        d = d + length * step
    return None


def _downhill(contacts: Array, stiffness: Array, slope: Array) -> Array:
    """The step down what no contact resists, or to the least value of the piece."""
    values, axes = np.linalg.eigh((contacts * stiffness[:, None]).T @ contacts)
    free = values <= _FREE * len(contacts)
    along = axes.T @ slope
    if np.abs(along[free]).max(initial=0.0) > _BALANCED:
        step: Array = -axes[:, free] @ along[free]
        return step
    newton: Array = -axes[:, ~free] @ (along[~free] / values[~free])
    return newton


def _least_along(stretched: Array, by_step: Array, move: Array, need: float) -> float | None:
    """Where along the step Phi is least, in steps; None where it falls without end.

    Phi'(t) = sum max(0, stretched_j + t by_step_j) move_j + need.
    """
    turns = np.abs(by_step) > 0.0
    at = -stretched[turns] / by_step[turns]
    times = np.concatenate([[0.0], np.sort(at[at > 0.0])])
    slopes = np.maximum(stretched + times[:, None] * by_step, 0.0) @ move + need
    k = int(np.argmax(slopes >= 0.0)) if np.any(slopes >= 0.0) else len(times)
    if 0 < k < len(times):
        share = -slopes[k - 1] / (slopes[k] - slopes[k - 1])
        return float(times[k - 1] + share * (times[k] - times[k - 1]))
    if k == 0:
        return 0.0 if slopes[0] > 0.0 else float(times[0])
    last = stretched + (times[-1] + 1.0) * by_step > 0.0
    rise = float(np.sum(by_step[last] * move[last]))
    if not rise > _NO_RISE * float(move @ move):
        return None
    return float(times[-1] - slopes[-1] / rise)
