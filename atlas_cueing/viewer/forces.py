"""Draws the specific force as an arrow at the head, in cabin axes.

It is the force of the seat on the rider, so that 1 g upright points up.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..rotation import IDENTITY, flip, norm, scale, shortest_arc
from ..rotations import Array
from ..signals import STANDARD_GRAVITY
from .shapes import rod

if TYPE_CHECKING:
    from viser import SceneApi

USUAL = 2.0  # g (assumed); the largest of a flight that is not known yet, more is drawn as this
# of the sphere's radius: the longest arrow; at the top of the stage its label is still in the
# picture
_REACH = 0.9
_MOST_UNIT = 0.62  # of the sphere's radius, at 1 g: a gentle flight is not drawn larger
_MOST = 8.0  # g; of a crash, more is drawn as this, so that 1 g can still be seen
_SHORTEST = 1e-3  # g; less has no direction worth showing
_STEP = 0.1  # g; of the number at the arrow's head


class ForceScale:
    """The scale of forces in the picture, in which the largest of a flight still fits.

    largest: force (g) of the longest arrow.
    unit: length of 1 g, m.
    """

    def __init__(self, radius: float, largest: float = USUAL) -> None:
        """Scale forces up to `largest` (g) in a sphere of `radius` (m).

        Larger ones are drawn with the same length.
        """
        self.largest = min(max(largest, _REACH / _MOST_UNIT), _MOST)
        self.unit = _REACH * radius / self.largest

    def length(self, size: float) -> float:
        """Return the length (m) of a force of `size` g."""
        return self.unit * min(size, self.largest)

    @property
    def description(self) -> str:
        """The scale in words."""
        longest = f"at most {self.length(self.largest):.2f} m ({self.largest:.1f} g)"
        return f"arrows are specific force: 1 g = {self.unit:.2f} m, {longest}"


def largest_g(*forces: Array) -> float:
    """Return the largest force (g) among rows of forces (n, 3), m/s^2.

    Rows that are not finite do not count; without any other it is 0.
    """
    sizes = [np.linalg.norm(rows[np.isfinite(rows).all(axis=1)], axis=1) for rows in forces]
    return (
        max((float(found.max()) for found in sizes if len(found)), default=0.0) / STANDARD_GRAVITY
    )


class ForceArrow:
    """An arrow whose length is the force; its label has a name and the number of g."""

    def __init__(
        self,
        scene: "SceneApi",
        path: str,
        drawn: ForceScale,
        thick: float,
        colour: tuple[int, int, int],
        name: str,
        anchor: Literal["bottom-left", "bottom-right"],
    ) -> None:
        """Draw the arrow in the frame above `path`, `thick` m; `anchor` is the label's corner."""
        self._drawn, self._name, self._text = drawn, name, ""
        up = (0.0, 0.0, 1.0)
        self._frame = scene.add_frame(path, show_axes=False)
        vertices, faces = rod((0.0, 0.0, 0.0), up, thick)
        self._shaft = scene.add_mesh_simple(
            f"{path}/shaft", vertices, faces, color=colour, cast_shadow=False
        )
        vertices, faces = rod((0.0, 0.0, 0.0), scale(7.0 * thick, up), 2.4 * thick, 0.0)
        self._tip = scene.add_mesh_simple(
            f"{path}/tip", vertices, faces, color=colour, cast_shadow=False
        )
        self._label = scene.add_label(
            f"{path}/tip/name", name, position=scale(7.0 * thick, up), anchor=anchor
        )

    def show(self, force: Sequence[float] | Array) -> None:
        """Point along `force` (m/s^2, cabin FRD)."""
        x, y, z = force
        along = flip((float(x), float(y), float(z)))
        size = norm(along) / STANDARD_GRAVITY
        length = self._drawn.length(size)
        self._frame.wxyz = shortest_arc((0.0, 0.0, 1.0), along) if size > _SHORTEST else IDENTITY
        self._shaft.scale = (1.0, 1.0, max(length, 1e-6))
        self._tip.position = (0.0, 0.0, length)
        self._say(f"{self._name} {_STEP * round(size / _STEP):.1f} g")

    def _say(self, text: str) -> None:
        """Change the label if its text is another one: every change is a message to the page."""
        if text != self._text:
            self._label.text = self._text = text
