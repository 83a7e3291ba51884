"""The rigid body that the wheels turn: shell, cabin and rider together."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..rotation import Mat3, Vec3

_ROUNDING = 1e-9  # of the largest principal moment: a thin plate reaches equality


@dataclass(frozen=True, slots=True)
class Part:
    """One part of the body.

    mass in kg; com_S: its centre of mass from the sphere centre, m, frame S; inertia_S: its inertia
    tensor about its own centre of mass, kg m^2, axes of S.
    """

    mass: float
    com_S: Vec3
    inertia_S: Mat3


@dataclass(frozen=True, slots=True)
class Body:
    """All parts as one rigid body.

    mass in kg; com_S: centre of mass from the sphere centre, m, frame S; inertia_S: inertia tensor
    about the SPHERE CENTRE, kg m^2, axes of S.
    """

    mass: float
    com_S: Vec3
    inertia_S: Mat3


def body_of(parts: Sequence[Part]) -> Body:
    """Put parts together as one rigid body (parallel axis theorem).

    m = sum m_k, c = sum m_k c_k / m, I = sum [I_k + m_k (|c_k|^2 1 - c_k c_k^T)].

    Raises InputError when the parts have no mass.
    """
    mass = sum(part.mass for part in parts)
    if not mass > 0.0:
        raise InputError(f"the parts weigh {mass:g} kg in all, allowed: mass > 0")
    inertia, first_moment = np.zeros((3, 3)), np.zeros(3)
    for part in parts:
        c = np.array(part.com_S)
        inertia += np.array(part.inertia_S) + part.mass * (c @ c * np.eye(3) - np.outer(c, c))
        first_moment += part.mass * c
    x, y, z = (first_moment / mass).tolist()
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = inertia.tolist()
    return Body(mass, (x, y, z), inertia_tensor((xx, yy, zz, xy, xz, yz)))


def inertia_tensor(elements: Sequence[float]) -> Mat3:
    """Inertia tensor from three or six of its elements, kg m^2.

    elements: xx, yy, zz, and xy, xz, yz if there are six. They are elements of the tensor: those
    off the diagonal are minus the products of inertia.
    """
    xx, yy, zz, xy, xz, yz = (*elements, 0.0, 0.0, 0.0)[:6]
    return ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))


def is_realizable(inertia: Mat3) -> bool:
    """Whether a rigid body can have this tensor about its centre of mass.

    No principal moment is negative, and none exceeds the sum of the other two (triangle
    inequality: I_1 + I_2 - I_3 = 2 integral of x_3^2 dm >= 0).
    """
    least, middle, largest = np.linalg.eigvalsh(np.array(inertia)).tolist()
    slack = _ROUNDING * max(abs(largest), abs(least))
    return bool(least >= -slack and largest <= least + middle + slack)
