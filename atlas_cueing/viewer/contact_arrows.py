"""Draws what each wheel pushes the sphere with, as an arrow whose tip is at the contact.

Its length is the force: a third of the sphere's radius at rest. It turns red while the wheel slips
or does not touch.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..evaluation import RunColumns
from ..loads import balance, reserve
from ..rotation import shortest_arc
from ..rotations import Array
from ..scenario import Platform
from .shapes import draw, rod

if TYPE_CHECKING:
    from viser import SceneApi

_GRIP, _SLIP = (0, 114, 178), (200, 30, 30)  # blue of Okabe & Ito 2008; red for a fault
_AT_REST = 0.33  # of the sphere's radius
_LONGEST = 1.2  # of the sphere's radius
_THICK = 0.022  # of the sphere's radius
_SHORTEST = 1e-6  # of the sphere's radius


class ContactArrows:
    """The arrows of all wheels of a platform with masses; hidden until the first forces."""

    def __init__(self, scene: "SceneApi", path: str, platform: Platform) -> None:
        """Draw them in the stage's frame `path`."""
        self._radius = platform.sphere.radius_m
        rest = reserve(platform.load_model()).rest
        largest = float(np.abs(rest.normal).max())
        self._unit = _AT_REST * self._radius / max(largest, 1e-9)  # m for 1 N
        self._arrows = [
            self._arrow(scene, f"{path}/contact_force_{k + 1}", wheel.wheel().contact)
            for k, wheel in enumerate(platform.wheel)
        ]

    def _arrow(
        self, scene: "SceneApi", path: str, contact: tuple[float, float, float]
    ) -> tuple[Any, list[Any]]:
        """A frame at the contact, z along the force, and in it the arrow in both colours."""
        place = self._radius * np.array(contact)
        frame = scene.add_frame(path, show_axes=False, position=place, visible=False)
        thick = _THICK * self._radius
        shafts = []
        for name, colour in (("grip", _GRIP), ("slip", _SLIP)):
            shaft = scene.add_frame(f"{path}/{name}", show_axes=False)
            mesh = rod((0.0, 0.0, -1.0), (0.0, 0.0, -5.0 * thick), thick)
            draw(scene, f"{path}/{name}/shaft", mesh, colour)
            mesh = rod((0.0, 0.0, -5.0 * thick), (0.0, 0.0, 0.0), 2.4 * thick, 0.0)
            draw(scene, f"{path}/{name}/tip", mesh, colour)
            shafts.append(shaft)
        return frame, shafts

    def show(self, forces: Array, slipping: NDArray[np.bool_]) -> None:
        """Point along `forces` (N, 3), N, W; `slipping` (N,) chooses the colour."""
        for (frame, shafts), force, slips in zip(self._arrows, forces, slipping, strict=True):
            size = float(np.linalg.norm(force))
            length = min(self._unit * size, _LONGEST * self._radius)
            frame.visible = length > _SHORTEST * self._radius
            if frame.visible:
                x, y, z = (float(c) for c in force)
                frame.wxyz = shortest_arc((0.0, 0.0, 1.0), (x, y, z))
                frame.scale = length
            for shaft, of_slip in zip(shafts, (False, True), strict=True):
                shaft.visible = bool(slips) == of_slip


def contact_forces(
    platform: Platform, flight: RunColumns
) -> tuple[Array, NDArray[np.bool_]] | None:
    """What the wheels push the sphere with (n, N, 3), N, W, and whether they slip (n, N).

    None for a platform without masses. Numbers that are not finite count 0.
    """
    if not platform.has_loads:
        return None
    model = platform.load_model()
    with np.errstate(all="ignore"):
        motion = (flight.motion_q_WS, flight.motion_w_W, flight.motion_alpha_W, flight.motion_a_W)
        loads = balance(model, *motion)
        forces = loads.drive[:, :, None] * model.V - loads.normal[:, :, None] * model.U
    slipping: NDArray[np.bool_] = ~(loads.traction_use <= 1.0)
    return np.nan_to_num(forces, posinf=0.0, neginf=0.0), slipping
