"""How fast the sphere may turn, and speed up, inside the wheels' own limits."""

from dataclasses import dataclass

from ..rotation import Mat3, Vec3, norm
from ..signals import WheelLimits
from .geometry import Geometry


@dataclass(frozen=True, slots=True)
class Headroom:
    """Largest sphere rate (rad/s) and acceleration (rad/s^2).

    About x, y, z of W alone, and about the worst axis of all.
    """

    rate: Vec3
    worst_rate: float
    acceleration: Vec3
    worst_acceleration: float


def headroom(geometry: Geometry, limits: WheelLimits) -> Headroom:
    """Give what `limits` leave of the sphere's motion; infinite where an axis turns no wheel."""
    rows = geometry.wheels_from_sphere
    return Headroom(
        rate=_about_axes(rows, limits.speed),
        worst_rate=_about_worst(rows, limits.speed),
        acceleration=_about_axes(rows, limits.acceleration),
        worst_acceleration=_about_worst(rows, limits.acceleration),
    )


def _about_axes(rows: Mat3, limit: Vec3) -> Vec3:
    """Largest c with |row_i . (c axis)| <= limit_i for all wheels, for each axis."""
    x, y, z = (min(_ratio(limit[i], abs(rows[i][axis])) for i in range(3)) for axis in range(3))
    return (x, y, z)


def _about_worst(rows: Mat3, limit: Vec3) -> float:
    """Distance from the origin to the nearest pair of planes |row_i . Omega| = limit_i."""
    return min(_ratio(limit[i], norm(rows[i])) for i in range(3))


def _ratio(limit: float, speed: float) -> float:
    return limit / speed if speed > 0.0 else float("inf")
