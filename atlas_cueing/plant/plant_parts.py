"""The body, a wheel and a servo of the plant."""

# mypyc: runs every tick

from dataclasses import dataclass
from math import pi

from ..rotation import Mat3, Vec3
from .rolling_contact import RollingContact


@dataclass(frozen=True, slots=True)
class PlantBody:
    """Mass (kg), centre of mass from the sphere centre (m), inertia about it, its inverse; S."""

    mass: float
    com_S: Vec3
    inertia_S: Mat3
    inverse_S: Mat3


@dataclass(frozen=True, slots=True)
class PlantServo:
    """Servo of each wheel: k_p N m s, k_i N m, limit N m, inertia kg m^2, losses N m s, N m."""

    speed_gain: float
    angle_gain: float
    limit: float
    inertia: float
    viscous: float
    coulomb: float


@dataclass(frozen=True, slots=True)
class PlantWheel:
    """A wheel by its rows of rollers: one contact, or two that take turns.

    rows: contacts of row +1 and -1, or the only one. pitch: angle of the wheel from one roller of a
    row to the next, rad.
    """

    rows: tuple[RollingContact, ...]
    pitch: float = 2.0 * pi

    def touching(self, angle: float) -> RollingContact:
        """The row that touches with the wheel at `angle` (rad)."""
        if len(self.rows) == 1:
            return self.rows[0]
        turned = angle / self.pitch
        return self.rows[0 if turned - turned // 1.0 < 0.5 else 1]
