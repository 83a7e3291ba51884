"""Draws what turns: the sphere with marks that show its orientation, and the cockpit inside.

Frame S: x forward, y left, z up.
"""

from typing import TYPE_CHECKING

import numpy as np

from ..rotations import Array
from ..scenario import Platform
from .shapes import Colour, Mesh, circle, draw, merged, patch, rod

if TYPE_CHECKING:
    from viser import FrameHandle, SceneApi

_UPPER: Colour = (60, 140, 220)  # sky and earth, as on an attitude indicator
_LOWER: Colour = (186, 104, 34)
_INK: Colour = (44, 52, 64)
_WHITE: Colour = (250, 250, 250)
_NOSE: Colour = (214, 60, 40)
_SEAT: Colour = (52, 58, 70)
_SUIT: Colour = (232, 138, 36)
_SKIN: Colour = (244, 208, 176)
_SCREEN: Colour = (64, 190, 220)
_MAN = 1.45  # m; radius of the sphere in which the rider is drawn life-size
_UP, _PI = np.radians(90.0), np.pi


def draw_cabin(scene: "SceneApi", path: str, platform: Platform) -> "FrameHandle":
    """Draw the cabin under `path`; return its frame, whose `wxyz` turns it."""
    radius = platform.sphere.radius_m
    frame = scene.add_frame(path, show_axes=False)
    _draw_shell(scene, path, radius)
    _draw_marks(scene, path, radius)
    _draw_cockpit(scene, path, radius)
    _draw_rider(scene, path, radius, np.array(platform.head_S))
    return frame


def _draw_shell(scene: "SceneApi", path: str, radius: float) -> None:
    """Draw two transparent halves, sky above and earth below."""
    for name, colour, elevation, opacity in (
        ("sky", _UPPER, (0.0, _UP), 0.22),
        ("earth", _LOWER, (-_UP, 0.0), 0.46),
    ):
        vertices, faces = patch(radius, (0.0, 2.0 * _PI), elevation)
        scene.add_mesh_simple(
            f"{path}/{name}",
            vertices,
            faces,
            color=colour,
            opacity=opacity,
            side="double",
            cast_shadow=name == "earth",
        )


def _draw_marks(scene: "SceneApi", path: str, radius: float) -> None:
    """Draw a chequered belt at the horizon, a grid, a red nose, a white crown, a dark tail."""
    belt, half = np.radians(2.6), np.radians(7.5)
    for name, colour, first in (("belt_dark", _INK, 0.0), ("belt_light", _WHITE, 2.0 * half)):
        starts = first + 4.0 * half * np.arange(12)
        squares = [patch(1.004 * radius, (a - half, a + half), (-belt, belt)) for a in starts]
        draw(scene, f"{path}/{name}", merged(squares), colour)
    lines = [
        circle(1.002 * radius, (np.cos(a), np.sin(a), 0.0), (0.0, 0.0, 1.0))
        for a in np.radians(np.arange(0.0, 180.0, 30.0))
    ]
    for elevation in np.radians([-60.0, -30.0, 30.0, 60.0]):
        height = (0.0, 0.0, 1.002 * radius * np.sin(elevation))
        lines.append(
            circle(1.002 * radius * np.cos(elevation), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)) + height
        )
    scene.add_line_segments(
        f"{path}/net", points=np.vstack(lines), colors=_INK, thickness=0.006 * radius
    )
    vertices, faces = patch(1.008 * radius, (0.0, 2.0 * _PI), (_UP - np.radians(9.0), _UP))
    draw(scene, f"{path}/crown", (vertices, faces), _WHITE)
    draw(scene, f"{path}/nose", (vertices[:, [2, 0, 1]], faces), _NOSE)
    draw(scene, f"{path}/tail", (vertices[:, [2, 0, 1]] * (-1.0, -1.0, 1.0), faces), _INK)


def _draw_cockpit(scene: "SceneApi", path: str, radius: float) -> None:
    """Draw a deck, a console and a screen all round the front."""
    deck = -0.72 * radius
    draw(
        scene,
        f"{path}/deck",
        rod((0.0, 0.0, deck - 0.02 * radius), (0.0, 0.0, deck), 0.66 * radius, sides=48),
        (120, 128, 140),
    )
    for name, colour, distance, azimuth, elevation, opacity in (
        ("console", _SEAT, 0.62, 44.0, (-44.0, -24.0), 1.0),
        ("screen", _SCREEN, 0.86, 56.0, (-14.0, 22.0), 0.5),
    ):
        vertices, faces = patch(
            distance * radius, _radians(-azimuth, azimuth), _radians(*elevation)
        )
        scene.add_mesh_simple(
            f"{path}/{name}",
            vertices,
            faces,
            color=colour,
            opacity=opacity,
            side="double",
            cast_shadow=name == "console",
        )


def _draw_rider(scene: "SceneApi", path: str, radius: float, head: Array) -> None:
    """Draw a seated rider below the platform's `rider.head_m`."""
    size = radius / _MAN

    def limbs(
        pairs: list[tuple[tuple[float, float, float], tuple[float, float, float], float]],
    ) -> Mesh:
        """Return rods between pairs of points with a radius each, in m of a man of usual size."""
        return merged(
            [
                rod(head + size * np.array(a), head + size * np.array(b), size * r)
                for a, b, r in pairs
            ]
        )

    scene.add_icosphere(f"{path}/face", radius=0.12 * size, color=_SKIN, position=tuple(head))
    scene.add_icosphere(
        f"{path}/helmet",
        radius=0.135 * size,
        color=_WHITE,
        position=tuple(head + size * np.array((-0.03, 0.0, 0.03))),
    )
    body = [((-0.06, 0.0, -0.70), (-0.02, 0.0, -0.18), 0.17)]
    for side in (-1.0, 1.0):
        body += [
            ((-0.02, 0.24 * side, -0.24), (0.22, 0.28 * side, -0.48), 0.055),  # arms
            ((0.22, 0.28 * side, -0.48), (0.52, 0.18 * side, -0.44), 0.045),
            ((-0.05, 0.11 * side, -0.70), (0.42, 0.13 * side, -0.64), 0.085),  # thighs
            ((0.42, 0.13 * side, -0.64), (0.56, 0.13 * side, -1.02), 0.06),  # shins
        ]
    draw(scene, f"{path}/suit", limbs(body), _SUIT)
    scene.add_box(
        f"{path}/seat",
        color=_SEAT,
        dimensions=_scaled(size, 0.52, 0.5, 0.1),
        position=head + size * np.array((0.1, 0.0, -0.84)),
    )
    scene.add_box(
        f"{path}/back",
        color=_SEAT,
        dimensions=_scaled(size, 0.1, 0.5, 0.95),
        position=head + size * np.array((-0.29, 0.0, -0.42)),
    )


def _radians(low: float, high: float) -> tuple[float, float]:
    return (float(np.radians(low)), float(np.radians(high)))


def _scaled(size: float, *lengths: float) -> tuple[float, float, float]:
    x, y, z = (size * length for length in lengths)
    return (x, y, z)
