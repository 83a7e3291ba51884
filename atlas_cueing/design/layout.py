"""Where wheels stand around the sphere, in a few numbers, and the platform that has them there.

The symmetric family: N wheels evenly around z, each at the elevation theta below the equator, its
drive turned by the skew psi in the tangent plane. With the azimuth phi of a wheel, in W,

    h = (sin phi, -cos phi, 0)                          horizontal tangent
    u = (cos theta cos phi, cos theta sin phi, -sin theta)   contact
    v = cos psi h + sin psi (u x h)                     drive

The vertical part of u x v is cos theta cos psi, whatever phi, so that three induced rows are
orthogonal (condition number 1) where cos theta cos psi = 1 / sqrt 3: at any theta <= 54.74 deg.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import asin, atan2, cos, degrees, hypot, pi, radians, remainder, sin, sqrt, tau
from typing import Any

from ..errors import InputError
from ..rotation import Vec3, add, cross, dot, scale
from ..scenario import Platform

_SAME = 1e-3  # rad, and of a radius: wheels typed with three decimals still are alike


@dataclass(frozen=True, slots=True)
class Layout:
    """A symmetric layout, by the words of `--vary`.

    elevation, skew, azimuth: theta, psi and phi of the first wheel, deg. radius: of each wheel, m,
    as in its `radius_m`. gear: turns of the motor for one of the wheel.
    """

    elevation: float
    skew: float
    azimuth: float
    radius: float
    gear: float

    def with_values(self, values: Mapping[str, float]) -> "Layout":
        """The layout with some of its numbers replaced."""
        return Layout(**asdict(self) | dict(values))


def layout_of(platform: Platform) -> Layout:
    """Find the layout of a platform.

    Raises InputError for one whose wheels are not evenly around z and all alike.
    """
    rows = [_angles(wheel.wheel().contact, wheel.wheel().drive) for wheel in platform.wheel]
    radii = [wheel.radius_m for wheel in platform.wheel]
    theta, psi, phi = rows[0]
    turns = sorted((row[2] - phi) % tau for row in rows)
    even = all(
        abs(remainder(turn - tau * k / len(rows), tau)) < _SAME for k, turn in enumerate(turns)
    )
    alike = all(
        abs(row[0] - theta) < _SAME and abs(remainder(row[1] - psi, tau)) < _SAME for row in rows
    )
    if not (even and alike and max(radii) - min(radii) < _SAME * min(radii)):
        raise InputError(
            f"platform {platform.name!r}: its wheels are not alike and evenly around z, allowed in"
            " a design: one elevation, skew and radius for all; begin with atlas-2.9m, say"
        )
    gear = platform.drive.gear if platform.drive and platform.drive.gear else 1.0
    return Layout(degrees(theta), degrees(psi), degrees(phi), radii[0], gear)


def with_layout(platform: Platform, layout: Layout) -> Platform:
    """The platform with its wheels laid out so; nothing else is changed.

    Held fixed: sphere, parts, preloads, supports, limits, and of each wheel friction, inertia,
    stiffness, roller angle and rows. The motor is held fixed too: the torque that it gives at the
    axle goes with the gear, and its inertia there with the square of it.
    """
    first = layout_of_wheel(platform, 0)
    wheels = []
    for k, wheel in enumerate(platform.wheel):
        turn = layout_of_wheel(platform, k) - first
        contact, drive = directions(layout, radians(layout.azimuth) + turn)
        changed = {"contact": contact, "drive": drive, "radius_m": layout.radius}
        wheels.append(wheel.model_copy(update=changed))
    return platform.model_copy(update={"wheel": tuple(wheels), "drive": _geared(platform, layout)})


def layout_of_wheel(platform: Platform, k: int) -> float:
    """Azimuth of a wheel, rad, from x towards y of W."""
    x, y, _ = platform.wheel[k].contact
    return atan2(y, x)


def directions(layout: Layout, azimuth: float) -> tuple[Vec3, Vec3]:
    """Contact and drive, unit vectors in W, of a wheel at the azimuth (rad)."""
    theta, psi = radians(layout.elevation), radians(layout.skew)
    level = (sin(azimuth), -cos(azimuth), 0.0)
    u = (cos(theta) * cos(azimuth), cos(theta) * sin(azimuth), -sin(theta))
    return u, add(scale(cos(psi), level), scale(sin(psi), cross(u, level)))


def clearance(platform: Platform) -> float:
    """How far the lowest point of the wheels lies above the sphere's lowest point, m.

    A wheel of radius r is a disc about the axle b = u x v, with its centre at (R + r) u: its lowest
    point is at (R + r) u_z - r sqrt(1 - b_z^2). Negative: wheels reach below the sphere.
    """
    R = platform.sphere.radius_m
    wheels = [(wheel.radius_m, wheel.wheel()) for wheel in platform.wheel]
    lowest = [
        (R + r) * w.contact[2] - r * sqrt(max(1.0 - w.induced[2] ** 2, 0.0)) for r, w in wheels
    ]
    return min(lowest) + R


def wheel_gap(platform: Platform) -> float:
    """Room between neighbouring wheels, taken as balls of their radius, m; negative: they meet."""
    R, wheels = platform.sphere.radius_m, platform.wheel
    centres = [scale(R + wheel.radius_m, wheel.wheel().contact) for wheel in wheels]
    return min(
        sqrt(sum((a - b) ** 2 for a, b in zip(centres[i], centres[j], strict=True)))
        - wheels[i].radius_m
        - wheels[j].radius_m
        for i in range(len(wheels))
        for j in range(i)
    )


def _geared(platform: Platform, layout: Layout) -> Any:
    drive = platform.drive
    if drive is None or layout.gear == (drive.gear or 1.0):
        return drive
    ratio = layout.gear / (drive.gear or 1.0)
    torques = {
        key: ratio * value
        for key in ("torque_n_m", "torque_rms_n_m")
        if (value := getattr(drive, key)) is not None
    }
    return drive.model_copy(update={"gear": layout.gear, **torques})


def _angles(u: Vec3, v: Vec3) -> tuple[float, float, float]:
    """Elevation, skew and azimuth of a wheel, rad."""
    if not hypot(u[0], u[1]) > _SAME:
        return -pi / 2.0, 0.0, 0.0  # at a pole, where no azimuth is
    phi = atan2(u[1], u[0])
    level = (sin(phi), -cos(phi), 0.0)
    return asin(max(-1.0, min(1.0, -u[2]))), atan2(dot(v, cross(u, level)), dot(v, level)), phi
