"""What rides on a track; apart from the ride, whose libraries take seconds to import."""

from dataclasses import dataclass

from ..rotation import Vec3

PER_POINT = 16  # steps between two points of the track


@dataclass(frozen=True, slots=True)
class Car:
    """What rides: speed at the first point (m/s), friction, drag (1/m) and speed of the lift (m/s).

    head: of the rider from the track, m, forward, right, down.
    """

    speed: float
    friction: float = 0.0
    drag: float = 0.0
    lift_speed: float = 0.0
    head: Vec3 = (0.0, 0.0, 0.0)
