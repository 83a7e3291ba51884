"""Platforms to smooth on: equilateral at 40 deg, orthogonal, and every limit different."""

from dataclasses import dataclass

import numpy as np

from atlas_cueing.rotations import Array
from atlas_cueing.signals import StageLimits, WheelLimits
from atlas_cueing.smoothing import Smoothing


@dataclass(frozen=True)
class Platform:
    """J^-1 as an array, and the limits."""

    wheels_from_sphere: Array
    wheels: WheelLimits
    stage: StageLimits

    def smoothing(self, dt: float) -> Smoothing:
        rows, columns = (
            self.wheels_from_sphere.tolist(),
            np.linalg.inv(self.wheels_from_sphere).tolist(),
        )
        return Smoothing(
            dt=dt,
            wheels_from_sphere=(tuple(rows[0]), tuple(rows[1]), tuple(rows[2])),
            sphere_from_wheels=(tuple(columns[0]), tuple(columns[1]), tuple(columns[2])),
            wheel_limits=self.wheels,
            stage_limits=self.stage,
        )


def equilateral_rows(radius: float = 1.45, wheel: float = 0.15) -> Array:
    """R / r times contact x drive (Eq. 11, 22): three wheels 120 deg apart.

    They are 40 deg below the equator.
    """
    low = np.radians(40.0)
    rows = []
    for azimuth in np.radians([0.0, 240.0, 120.0]):
        contact = [np.cos(low) * np.cos(azimuth), np.cos(low) * np.sin(azimuth), -np.sin(low)]
        drive = [np.sin(azimuth), -np.cos(azimuth), 0.0]
        rows.append(np.cross(contact, drive))
    return radius / wheel * np.array(rows)


EQUILATERAL = Platform(
    equilateral_rows(),
    WheelLimits((31.0,) * 3, (60.0,) * 3, (600.0,) * 3),
    StageLimits((1.0, 1.0, 0.75), (1.5, 1.5, 1.2), (6.0, 6.0, 5.0), (60.0, 60.0, 50.0)),
)
ORTHOGONAL = Platform(
    np.diag([1.45 / 0.15] * 3),
    WheelLimits((20.0,) * 3, (100.0,) * 3, (500.0,) * 3),
    StageLimits((0.5, 2.0, 0.1), (3.0, 1.0, 0.5), (3.0, 10.0, 4.0), (30.0, 400.0, 20.0)),
)
UNEQUAL = Platform(
    equilateral_rows(0.75, 0.05) @ np.array([[1.0, 0.2, 0.0], [0.0, 1.0, -0.3], [0.4, 0.0, 1.0]]),
    WheelLimits((31.0, 5.0, 60.0), (60.0, 200.0, 15.0), (600.0, 900.0, 40.0)),
    StageLimits((0.05, 5.0, 0.3), (2.0, 0.3, 1.2), (20.0, 2.0, 0.5), (90.0, 8.0, 100.0)),
)
PLATFORMS = {"equilateral": EQUILATERAL, "orthogonal": ORTHOGONAL, "unequal": UNEQUAL}
