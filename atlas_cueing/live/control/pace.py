"""How long moves from rest to rest take: calm for the rider, and inside the platform's limits.

A move by x in T along smoothstep (`trajectories`) has at most a speed of 15/8 x / T, an
acceleration of 10 / sqrt(3) x / T^2 and a jerk of 60 x / T^3.
"""

# mypyc: runs every tick

from collections.abc import Sequence
from math import cbrt, sqrt
from typing import Final

from ...rotation import Mat3, Vec3, apply, norm
from .certified_axis import AxisLimits
from .trajectories import PEAK_BEND, PEAK_RATE, SHORTEST_PARKING, calm_time

_PEAK_JERK: Final = 60.0
# of speed, acceleration and jerk: a cue that takes a third of the jerk passes smoothing unchanged
_SHARE: Final = 0.3
SLOW: Final = 0.5  # of the calm speed, on the way home after a fault (assumed)


class Pace:
    """Durations of moves on one platform."""

    def __init__(self, wheels_from_sphere: Mat3, axes: Sequence[AxisLimits]) -> None:
        """Set up for J^-1 and the limits of wheels 1 to 3 and the stage's x, y, z."""
        self._wheels_from_sphere, self._axes = wheels_from_sphere, axes

    def parking_time(self, turn: Vec3, way: Vec3, slowly: bool) -> float:
        """Return the time (s) for a turn (rotation vector, rad, W) and a way (m, W) at once.

        slowly: at SLOW of the calm speed.
        """
        calm = calm_time(norm(turn), norm(way)) / (SLOW if slowly else 1.0)
        distances = (*apply(self._wheels_from_sphere, turn), *way)
        shortest = max(
            _shortest(axis, abs(x)) for axis, x in zip(self._axes, distances, strict=True)
        )
        return max(SHORTEST_PARKING, calm, shortest)


def _shortest(limits: AxisLimits, distance: float) -> float:
    """Return the time (s) in which an axis moves by `distance` with _SHARE of its limits."""
    return max(
        PEAK_RATE * distance / (_SHARE * limits.speed),
        sqrt(PEAK_BEND * distance / (_SHARE * limits.acceleration)),
        cbrt(_PEAK_JERK * distance / (_SHARE * limits.jerk)),
    )
