"""Makes meshes that viser lacks: vertices (n, 3) in m and faces (m, 3) of their numbers."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array

if TYPE_CHECKING:
    from viser import SceneApi

Mesh: TypeAlias = tuple[Array, NDArray[np.uint32]]
Colour: TypeAlias = tuple[int, int, int]

_FINE = np.radians(5.0)  # most that one facet of a sphere spans


def patch(radius: float, azimuth: tuple[float, float], elevation: tuple[float, float]) -> Mesh:
    """Return the part of a sphere between two azimuths (from x to y) and elevations, rad."""
    a = np.linspace(*azimuth, max(2, int(np.ceil((azimuth[1] - azimuth[0]) / _FINE)) + 1))
    e = np.linspace(*elevation, max(2, int(np.ceil((elevation[1] - elevation[0]) / _FINE)) + 1))
    ea, aa = (grid.ravel() for grid in np.meshgrid(e, a, indexing="ij"))
    return radius * np.column_stack(
        [np.cos(ea) * np.cos(aa), np.cos(ea) * np.sin(aa), np.sin(ea)]
    ), _grid(len(e), len(a))


def rod(
    start: Sequence[float] | Array,
    end: Sequence[float] | Array,
    radius: float,
    tip: float = 1.0,
    sides: int = 16,
) -> Mesh:
    """Return a closed rod from start to end, with `tip` times its radius there (0: a cone)."""
    start, end = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    along = (end - start) / np.linalg.norm(end - start)
    across = np.cross(along, (1.0, 0.0, 0.0) if abs(along[0]) < 0.7 else (0.0, 1.0, 0.0))
    across /= np.linalg.norm(across)
    turn = np.linspace(0.0, 2.0 * np.pi, sides + 1)[:, None]
    ring = radius * (np.cos(turn) * across + np.sin(turn) * np.cross(along, across))
    rows = [
        start + 0.0 * ring,
        start + ring,
        start + ring,
        end + tip * ring,
        end + tip * ring,
        end + 0.0 * ring,
    ]
    faces = np.vstack(
        [_grid(2, sides + 1) + 2 * k * (sides + 1) for k in range(3)]
    )  # two ends and the side, with edges between
    return np.vstack(rows), faces.astype(np.uint32)


def spindle(centre: Array, axis: Array, length: float, radius: float) -> Mesh:
    """Return a barrel with round flanks: an omni wheel's roller."""
    ends = [centre + s * length * axis for s in (-0.5, 0.0, 0.5)]
    return merged([rod(ends[1], ends[0], radius, 0.55, 8), rod(ends[1], ends[2], radius, 0.55, 8)])


def merged(meshes: Sequence[Mesh]) -> Mesh:
    """Return many meshes as one."""
    starts = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    faces = np.vstack(
        [faces + start for (_, faces), start in zip(meshes, starts[:-1], strict=True)]
    )
    return np.vstack([vertices for vertices, _ in meshes]), faces.astype(np.uint32)


def circle(
    radius: float, first: Sequence[float], second: Sequence[float], count: int = 96
) -> Array:
    """Return a circle through two directions at right angles, as segments (count, 2, 3)."""
    turn = np.linspace(0.0, 2.0 * np.pi, count + 1)[:, None]
    points = radius * (np.cos(turn) * np.asarray(first) + np.sin(turn) * np.asarray(second))
    return np.stack([points[:-1], points[1:]], axis=1)


def draw(scene: "SceneApi", path: str, mesh: Mesh, colour: Colour) -> None:
    """Put a mesh into the scene, in the frame above `path`."""
    vertices, faces = mesh
    scene.add_mesh_simple(path, vertices, faces, color=colour)


def _grid(rows: int, columns: int) -> NDArray[np.uint32]:
    """Return two triangles for each cell of a grid of vertices.

    They are counterclockwise where columns run to the right and rows up.
    """
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    lower = np.column_stack([first, first + 1, first + columns + 1])
    upper = np.column_stack([first, first + columns + 1, first + columns])
    return np.vstack([lower, upper]).astype(np.uint32)
