"""Actuator limits, per wheel and per stage axis."""

from dataclasses import dataclass

from ..rotation import Vec3


@dataclass(frozen=True, slots=True)
class WheelLimits:
    """Largest magnitude per wheel: speed rad/s, acceleration rad/s^2, jerk rad/s^3.

    stop_share: of the acceleration, that a certified stop brakes with; below 1 it is soft.
    """

    speed: Vec3
    acceleration: Vec3
    jerk: Vec3
    stop_share: float = 1.0


@dataclass(frozen=True, slots=True)
class StageLimits:
    """Largest magnitude per axis x, y, z of W.

    travel from the centre, m; speed, m/s; acceleration, m/s^2; jerk, m/s^3. stop_share as for
    wheels.
    """

    travel: Vec3
    speed: Vec3
    acceleration: Vec3
    jerk: Vec3
    stop_share: float = 1.0
