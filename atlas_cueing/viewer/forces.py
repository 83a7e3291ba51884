"""The specific force as an arrow at the head, in cabin axes: what pushes on the seat, so that 1 g upright points up."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..rotation import IDENTITY, flip, norm, scale, shortest_arc
from ..signals import STANDARD_GRAVITY
from .shapes import Array, rod

if TYPE_CHECKING:
    from viser import SceneApi

_LENGTH = 0.62  # of the sphere's radius, at 1 g
_LONGEST = 3.0  # g; more is drawn as this
_SHORTEST = 1e-3  # g; less has no direction worth showing


class ForceArrow:
    """An arrow whose length is the force."""

    def __init__(self, scene: "SceneApi", path: str, radius: float, colour: tuple[int, int, int], width: float) -> None:
        """Drawn in the frame above `path`, for a sphere of `radius` (m); `width` is a share of it."""
        self._unit = _LENGTH * radius
        up, thick = (0.0, 0.0, 1.0), width * radius
        self._frame = scene.add_frame(path, show_axes=False)
        vertices, faces = rod((0.0, 0.0, 0.0), up, thick)
        self._shaft = scene.add_mesh_simple(f"{path}/shaft", vertices, faces, color=colour, cast_shadow=False)
        vertices, faces = rod((0.0, 0.0, 0.0), scale(7.0 * thick, up), 2.4 * thick, 0.0)
        self._tip = scene.add_mesh_simple(f"{path}/tip", vertices, faces, color=colour, cast_shadow=False)

    def show(self, force: Sequence[float] | Array) -> None:
        """Point along `force` (m/s^2, cabin FRD)."""
        x, y, z = force
        along = flip((float(x), float(y), float(z)))
        size = norm(along) / STANDARD_GRAVITY
        length = self._unit * min(size, _LONGEST)
        self._frame.wxyz = shortest_arc((0.0, 0.0, 1.0), along) if size > _SHORTEST else IDENTITY
        self._shaft.scale = (1.0, 1.0, max(length, 1e-6))
        self._tip.position = (0.0, 0.0, length)
