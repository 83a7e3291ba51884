"""The last link of the chain: wheel speeds of an allowed motion."""

# mypyc: runs every tick

from ..errors import InputError
from ..rotation import Mat3, apply
from ..signals import Motion, WheelSpeeds
from .geometry import Geometry


class Wheels:
    """Wheel drive of one geometry (implements signals.WheelDrive).

    Raises SlipConditionError when the geometry is singular, and InputError unless it has three
    wheels.
    """

    def __init__(self, geometry: Geometry) -> None:
        if len(geometry.wheels) != 3:
            raise InputError(
                f"platform {geometry.name!r} has {len(geometry.wheels)} wheels, allowed in a run: 3"
            )
        self.sphere_from_wheels: Mat3 = _matrix(geometry.sphere_from_wheels)
        self.wheels_from_sphere: Mat3 = _matrix(geometry.wheels_from_sphere)

    def speeds(self, motion: Motion) -> WheelSpeeds:
        """Give speed (Eq. 22) and acceleration (Eq. 19, inverted) of each wheel.

        J is constant, so the same map serves both.
        """
        inverse = self.wheels_from_sphere
        return WheelSpeeds(
            motion.time, apply(inverse, motion.w_WS_W), apply(inverse, motion.alpha_WS_W)
        )


def _matrix(rows: tuple[tuple[float, ...], ...]) -> Mat3:
    (a, b, c), (d, e, f), (g, h, i) = rows
    return ((a, b, c), (d, e, f), (g, h, i))
