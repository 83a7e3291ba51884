"""The constants of the guard's check of traction, from a platform's file."""

from math import inf

import numpy as np

from ..loads import LoadModel
from ..rotation import Mat3, Vec3
from ..rotations import Array
from ..scenario import Platform
from .control.contact_check import ContactCheck, Six


def contact_check(platform: Platform) -> ContactCheck | None:
    """Return the check, where the platform says `[traction] keep = true`."""
    if platform.traction is None or not platform.traction.keep:
        return None
    return check_of(platform.load_model())


def check_of(model: LoadModel) -> ContactCheck:
    """Return the check of a sphere on three wheels."""
    u, v = model.U, model.V
    all_u, k = model.all_contacts, model.stiffness
    alone = np.array([0.0] * 3 + [each.preload for each in model.supports])
    pushed = -sum((p.force * np.array(p.contact) for p in model.preloads), np.zeros(3))
    matrix = np.block([
        [model.sphere_radius * np.cross(u, v).T, np.zeros((3, 3))],
        [v.T, -(all_u.T * k) @ all_u],
    ])  # fmt: skip
    m, c = model.body.mass, np.array(model.body.com_S)
    central = np.array(model.body.inertia_S) - m * (c @ c * np.eye(3) - np.outer(c, c))
    torque = model.drive.torque
    return ContactCheck(
        mass=m,
        com_S=model.body.com_S,
        central_inertia_S=_matrix(central),
        sphere_from_wheels=_matrix(model.sphere_from_wheels),
        inverse=_six(np.linalg.inv(matrix)),
        unloaded_W=_vector(alone @ all_u - pushed),
        contacts=[
            (_vector(way), float(stiff), float(n))
            for way, stiff, n in zip(all_u, k, alone, strict=True)
        ],
        grip=_vector(np.array([w.friction for w in model.wheels]) / model.traction_margin),
        axles=[(w.radius, w.inertia, w.viscous, w.coulomb) for w in model.wheels],
        torque=inf if torque is None else torque,
    )


def _vector(v: Array) -> Vec3:
    x, y, z = v.tolist()
    return (x, y, z)


def _matrix(m: Array) -> Mat3:
    a, b, c = m
    return (_vector(a), _vector(b), _vector(c))


def _six(m: Array) -> tuple[Six, Six, Six, Six, Six, Six]:
    rows: list[Six] = []
    for row in m:
        a, b, c, d, e, f = row.tolist()
        rows.append((a, b, c, d, e, f))
    one, two, three, four, five, six = rows
    return (one, two, three, four, five, six)
