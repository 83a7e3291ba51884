"""How fast the sphere may turn, and speed up, inside the wheels' own limits."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from ..rotation import Vec3, norm
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


class SpeedLimits(Protocol):
    """Limits of each wheel, as in `signals.WheelLimits`: speed rad/s, acceleration rad/s^2."""

    @property
    def speed(self) -> Sequence[float]:
        """Largest speed of each wheel."""

    @property
    def acceleration(self) -> Sequence[float]:
        """Largest acceleration of each wheel."""


def headroom(geometry: Geometry, limits: SpeedLimits) -> Headroom:
    """Give what `limits` leave of the sphere's motion; infinite where an axis turns no wheel."""
    rows = geometry.wheels_from_sphere
    return Headroom(
        rate=_about_axes(rows, limits.speed),
        worst_rate=_about_worst(rows, limits.speed),
        acceleration=_about_axes(rows, limits.acceleration),
        worst_acceleration=_about_worst(rows, limits.acceleration),
    )


def _about_axes(rows: Sequence[Vec3], limit: Sequence[float]) -> Vec3:
    """Largest c with |row_i . (c axis)| <= limit_i for all wheels, for each axis."""
    x, y, z = (min(map(_ratio, limit, (abs(row[axis]) for row in rows))) for axis in range(3))
    return (x, y, z)


def _about_worst(rows: Sequence[Vec3], limit: Sequence[float]) -> float:
    """Distance from the origin to the nearest pair of planes |row_i . Omega| = limit_i."""
    return min(map(_ratio, limit, map(norm, rows)))


def _ratio(limit: float, speed: float) -> float:
    return limit / speed if speed > 0.0 else float("inf")
