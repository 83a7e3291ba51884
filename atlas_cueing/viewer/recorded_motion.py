"""The motion of a recorded flight, tick by tick."""

import numpy as np

from ..errors import InputError
from ..evaluation import RunColumns
from ..rotations import Array
from ..scenario import Platform
from .contact_arrows import contact_forces
from .scene import Pose


class RecordedMotion:
    """Poses of a flight.

    Raises InputError when it has no ticks, or numbers in its motion that are not finite.
    """

    def __init__(self, flight: RunColumns, platform: Platform | None = None) -> None:
        """Take a flight, and the platform whose contact forces are shown with it."""
        if (
            not len(flight.time)
            or not np.isfinite(np.hstack([flight.motion_q_WS, flight.motion_p_W])).all()
        ):
            raise InputError("no motion to show: the log has no ticks, or numbers that are none")
        self._flight = flight
        self._contacts = contact_forces(platform, flight) if platform else None
        self._angle = wheel_angles(flight.time, flight.wheel_speed)

    def pose(self, tick: int) -> Pose:
        """Return the pose at a tick; a force that is not a number counts 0."""
        f = self._flight
        forces = (np.nan_to_num(f.vehicle_f_B[tick]), np.nan_to_num(f.felt_f[tick]))
        contacts = (part[tick] for part in self._contacts) if self._contacts else (None, None)
        place = (f.motion_q_WS[tick], f.motion_p_W[tick], self._angle[tick])
        return Pose(*place, *forces, *contacts)


def wheel_angles(time: Array, speed: Array) -> Array:
    """Return the angle of each wheel since the first tick, (n, 3), rad, by trapezoids.

    `time` (n,) is in s, `speed` (n, 3) in rad/s; one that is not a number counts 0.
    """
    steps = 0.5 * np.diff(time)[:, None] * (speed[:-1] + speed[1:])
    return np.concatenate([np.zeros((1, 3)), np.cumsum(np.nan_to_num(steps), axis=0)])
