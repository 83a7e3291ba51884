"""Draws the omni wheels where they touch the sphere, each on its motor."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ..rotation import Quat, shortest_arc
from ..scenario import Platform
from .shapes import Mesh, draw, merged, rod, spindle

if TYPE_CHECKING:
    from viser import SceneApi

Wheel = tuple[Any, Quat]  # the frame that turns, and the orientation that puts its z along the axle
_HUB, _ROLLER, _MARK, _MOTOR = (70, 78, 92), (28, 30, 36), (240, 196, 32), (104, 116, 134)
_ROLLERS = 14
_WIDTH = 0.55  # of the wheel's radius


def draw_wheels(scene: "SceneApi", path: str, platform: Platform) -> list[Wheel]:
    """Draw the three wheels in the stage's frame `path`; return each with its attitude at rest."""
    return [_draw_wheel(scene, f"{path}/wheel_{k + 1}", platform, k) for k in range(3)]


def _draw_wheel(scene: "SceneApi", path: str, platform: Platform, k: int) -> Wheel:
    """Draw a wheel that turns about -(contact x drive): its rim moves along `drive` there."""
    table = platform.wheel[k]
    wheel, r = table.wheel(), table.radius_m
    axle = -np.cross(wheel.contact, wheel.drive)
    at_rest = shortest_arc((0.0, 0.0, 1.0), (float(axle[0]), float(axle[1]), float(axle[2])))
    centre = np.array(wheel.contact) * (platform.sphere.radius_m + r)
    frame = scene.add_frame(path, show_axes=False, position=centre, wxyz=at_rest)
    for name, mesh, colour in (
        ("hub", _hub(r), _HUB),
        ("rollers", _rollers(r), _ROLLER),
        ("marks", _marks(r), _MARK),
    ):
        draw(scene, f"{path}/{name}", mesh, colour)
    draw(
        scene,
        f"{path}_motor",
        rod(centre + 0.5 * _WIDTH * r * axle, centre + 2.0 * r * axle, 0.55 * r),
        _MOTOR,
    )
    return frame, at_rest


def _hub(r: float) -> Mesh:
    return rod((0.0, 0.0, -0.5 * _WIDTH * r), (0.0, 0.0, 0.5 * _WIDTH * r), 0.78 * r, sides=32)


def _rollers(r: float) -> Mesh:
    """Return barrels round the rim with axles along it: the sphere may slip across the drive."""
    around = np.linspace(0.0, 2.0 * np.pi, _ROLLERS, endpoint=False)
    thick = 0.16 * r
    return merged(
        [
            spindle(
                (r - thick) * np.array((np.cos(a), np.sin(a), 0.0)),
                np.array((-np.sin(a), np.cos(a), 0.0)),
                0.36 * r,
                thick,
            )
            for a in around
        ]
    )


def _marks(r: float) -> Mesh:
    """Return three spokes on both faces, one of them thick, which show speed and sense."""
    spokes = []
    for side in (-0.5, 0.5):
        for angle, thick in ((0.0, 0.16), (2.1, 0.07), (4.2, 0.07)):
            end = (0.74 * r * np.cos(angle), 0.74 * r * np.sin(angle), side * _WIDTH * r)
            spokes.append(rod((0.0, 0.0, side * _WIDTH * r), end, thick * r, sides=8))
    return merged(spokes)
