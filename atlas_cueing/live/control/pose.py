"""Where a platform stands: at home, or where the last run has left it."""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, degrees, hypot
from typing import Final

from ...rotation import (
    IDENTITY,
    ZERO,
    Mat3,
    Quat,
    Vec3,
    apply,
    geodesic,
    integrate_base,
    normalise,
    subtract,
)
from .certified_axis import AxisLimits
from .command import Command, axes_of

AT_PARK: Final = 1e-3  # rad and m from upright in the centre
_STEP: Final = 1e-3  # s; the turn of a stop is integrated in such steps


@dataclass(frozen=True, slots=True)
class Pose:
    """A platform at rest.

    q_WS: orientation of the cabin.
    wheel_angle: of each wheel, rad, as the set points count them.
    p_WS_W: position of the stage, m.
    """

    q_WS: Quat = IDENTITY
    wheel_angle: Vec3 = ZERO
    p_WS_W: Vec3 = ZERO

    @property
    def is_home(self) -> bool:
        """Whether it is upright in the centre."""
        return geodesic(self.q_WS, IDENTITY) < AT_PARK and hypot(*self.p_WS_W) < AT_PARK

    def __str__(self) -> str:
        angle, distance = degrees(geodesic(self.q_WS, IDENTITY)), hypot(*self.p_WS_W)
        return f"{angle:.1f} deg from upright, {1e3 * distance:.0f} mm from the centre"


def pose_after_stop(
    q_WS: Quat, command: Command, axes: Sequence[AxisLimits], sphere_from_wheels: Mat3
) -> Pose:
    """Return where the drives come to rest if no other command follows this one.

    They fly the guard's stop from it; the turn is J times the wheels' own.

    Args:
        q_WS: orientation that belongs to the command.
        command: the last one.
        axes: limits of wheels 1 to 3 and the stage's x, y, z.
        sphere_from_wheels: J.
    """
    stops = [axis.stop(*state) for axis, state in zip(axes, axes_of(command), strict=True)]
    steps = ceil(max(stop.duration for stop in stops) / _STEP)
    angle, w = command.wheel_angle, apply(sphere_from_wheels, command.wheel_speed)
    for k in range(1, steps + 1):
        (q1, v1, _), (q2, v2, _), (q3, v3, _) = (stop.at(k * _STEP) for stop in stops[:3])
        before, angle, w0 = angle, (q1, q2, q3), w
        w = apply(sphere_from_wheels, (v1, v2, v3))
        turn = apply(sphere_from_wheels, subtract(angle, before))
        q_WS = normalise(integrate_base(q_WS, turn, w0, w, _STEP))
    x, y, z = (stop.end for stop in stops[3:])
    return Pose(q_WS, angle, (x, y, z))
