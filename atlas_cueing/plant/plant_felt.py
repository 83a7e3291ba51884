"""What the rider of the plant really feels."""

import numpy as np

from ..rotation import Vec3, rotate
from .drive_command import DriveCommand
from .sphere_on_wheels import GRAVITY, SphereOnWheels


def plant_felt(
    sphere: SphereOnWheels, command: DriveCommand, t: float, stage: Vec3, head_S: Vec3
) -> Vec3:
    """Specific force at the head, m/s^2, FRD: f = R^T (a + d'' - g) + alpha x r + w x w x r.

    The sphere is at t (s) into the command; stage: acceleration of the stage then, W.
    """
    alpha, against = sphere.accelerations(command, t)
    q, w = sphere.orientation(), sphere.state[4:7]
    back = (q[0], -q[1], -q[2], -q[3])
    a = (stage[0] + against[0], stage[1] + against[1], stage[2] + against[2] + GRAVITY)
    f = np.array(rotate(back, a))
    if any(head_S):
        r = np.array(head_S)
        f = f + np.cross(alpha, r) + np.cross(w, np.cross(w, r))
    return (float(f[0]), -float(f[1]), -float(f[2]))
