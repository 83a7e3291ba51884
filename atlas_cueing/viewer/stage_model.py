"""Draws the stage: floor, rails along x, a bridge with rails along y, a telescope along z.

Only the travel is the platform's; sizes are made up to fit it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ..rotation import Vec3
from ..rotations import Array
from ..scenario import Platform
from .shapes import Mesh, draw, merged, rod

if TYPE_CHECKING:
    from viser import SceneApi

_RAIL, _BRIDGE, _CARRIAGE, _TUBE, _ARM, _BOX = (
    (128, 138, 152),
    (92, 104, 122),
    (66, 84, 112),
    (176, 184, 194),
    (84, 98, 118),
    (36, 110, 190),
)
_BEAM = 0.085  # of the sphere's radius: half a beam's height
_PATHS = (
    "/bridge",
    "/bridge/carriage",
    "/bridge/carriage/telescope",
    "/bridge/carriage/telescope/top",
)


@dataclass(frozen=True, slots=True)
class Stage:
    """The parts that move, each in the frame of the one before; `floor` (m) is its height in W."""

    bridge: Any
    carriage: Any
    telescope: Any
    top: Any
    path: str
    floor: float

    def move(self, p_W: Sequence[float] | Array) -> None:
        """Put the sphere's centre at p_W (m)."""
        x, y, z = (float(part) for part in p_W)
        self.bridge.position = (x, 0.0, 0.0)
        self.carriage.position = (0.0, y, 0.0)
        self.telescope.position = self.top.position = (0.0, 0.0, 0.5 * z)


def draw_stage(scene: "SceneApi", platform: Platform) -> Stage:
    """Draw the stage with the sphere's centre at the origin of W.

    The frame `path` of the result carries sphere and wheels.
    """
    radius, travel = platform.sphere.radius_m, platform.stage_limit_values().travel
    bridge, carriage, telescope, top = (scene.add_frame(path, show_axes=False) for path in _PATHS)
    beam = _BEAM * radius
    plate = -(radius + 2.0 * max(wheel.radius_m for wheel in platform.wheel) + 0.1 * radius)
    deck = _draw_telescope(scene, plate, travel[2], radius)
    _draw_rails(scene, deck, travel, radius)
    size = (0.5 * radius, 0.5 * radius, beam)
    scene.add_box(
        f"{_PATHS[3]}/plate", color=_ARM, dimensions=size, position=(0.0, 0.0, plate - 0.5 * beam)
    )
    draw(scene, f"{_PATHS[3]}/arms", _arms(platform, plate - 0.4 * beam, 0.55 * beam), _ARM)
    _draw_travel(scene, np.array(travel), radius)
    floor = deck - 6.0 * beam
    _draw_floor(scene, radius, floor)
    return Stage(bridge, carriage, telescope, top, _PATHS[3], floor)


def _draw_telescope(scene: "SceneApi", plate: float, travel: float, radius: float) -> float:
    """Draw two tubes that slide by half the travel each out of a sleeve.

    Return the height (m) of the deck that the sleeve stands on.
    """
    tube, sunk = 1.05 * travel, 0.5 * _BEAM * radius  # into the plate
    for name, path, top, length, share, colour in (
        ("sleeve", _PATHS[1], plate - travel, 1.1 * tube, 0.3, _CARRIAGE),
        ("middle", _PATHS[2], plate - 0.5 * travel, tube, 0.24, _TUBE),
        ("inner", _PATHS[3], plate - sunk, tube - sunk, 0.18, _TUBE),
    ):
        draw(
            scene,
            f"{path}/{name}",
            rod((0.0, 0.0, top - length), (0.0, 0.0, top), share * radius, sides=40),
            colour,
        )
    return plate - travel - 1.1 * tube


def _draw_rails(scene: "SceneApi", deck: float, travel: Vec3, radius: float) -> None:
    """Draw from the deck down: sled, two beams along y that are the bridge, rails along x."""
    thick, half = 2.0 * _BEAM * radius, 0.62 * radius
    reach, side = travel[0] + half + 0.25 * radius, travel[1] + half + 0.25 * radius
    sled = (2.6 * half, 2.0 * half, thick)
    scene.add_box(
        f"{_PATHS[1]}/sled",
        color=_CARRIAGE,
        dimensions=sled,
        position=(0.0, 0.0, deck - 0.5 * thick),
    )
    for name, k in (("left", 1.0), ("right", -1.0)):
        rail, beam = (2.0 * reach, thick, thick), (thick, 2.0 * (side + thick), thick)
        scene.add_box(
            f"/rail_{name}",
            color=_RAIL,
            dimensions=rail,
            position=(0.0, k * side, deck - 2.5 * thick),
        )
        scene.add_box(
            f"{_PATHS[0]}/beam_{name}",
            color=_BRIDGE,
            dimensions=beam,
            position=(k * half, 0.0, deck - 1.5 * thick),
        )


def _draw_floor(scene: "SceneApi", radius: float, height: float) -> None:
    """Draw a floor that takes the shadow."""
    scene.add_grid(
        "/floor",
        width=14.0 * radius,
        height=14.0 * radius,
        cell_size=0.5 * radius,
        section_size=radius,
        cell_color=(214, 219, 226),
        section_color=(190, 198, 208),
        plane_color=(236, 239, 243),
        plane_opacity=1.0,
        shadow_opacity=0.35,
        position=(0.0, 0.0, height),
    )


def _arms(platform: Platform, plate: float, thick: float) -> Mesh:
    """Draw the arms from the plate round the sphere to each wheel's motor."""
    rods, radius, hub = [], platform.sphere.radius_m, np.array((0.0, 0.0, plate))
    for table in platform.wheel:
        wheel = table.wheel()
        contact = np.array(wheel.contact)
        motor = contact * (radius + table.radius_m) - 1.4 * table.radius_m * np.cross(
            wheel.contact, wheel.drive
        )
        out, reach = motor * (1.0, 1.0, 0.0), float(np.hypot(motor[0], motor[1]))
        knee = hub + out / max(reach, 1e-9) * max(
            reach, (0.7 if contact[2] < 0.0 else 1.3) * radius
        )
        above = knee * (1.0, 1.0, 0.0) + motor * (0.0, 0.0, 1.0)
        # over the top: pass the sphere first
        joints = [hub, knee, above, motor] if contact[2] > 0.5 else [hub, knee, motor]
        rods += [rod(a, b, thick, sides=12) for a, b in pairwise(joints)]
    return merged(rods)


def _draw_travel(scene: "SceneApi", travel: Array, radius: float) -> None:
    """Draw the box that the sphere's centre may move in."""
    corners = np.array([(a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]) * travel
    edges = [
        (i, j)
        for i in range(8)
        for j in range(i)
        if np.count_nonzero(corners[i] != corners[j]) == 1
    ]
    points = np.array([[corners[i], corners[j]] for i, j in edges])
    scene.add_line_segments("/travel", points=points, colors=_BOX, thickness=0.012 * radius)
