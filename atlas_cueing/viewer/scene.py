"""Draws the platform in space, for a live run, a log and a replay file."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..rotation import exp, multiply
from ..rotations import Array
from ..scenario import Platform
from .cabin_model import draw_cabin
from .contact_arrows import ContactArrows
from .forces import USUAL, ForceArrow, ForceScale
from .stage_model import Stage, draw_stage
from .wheel_models import draw_wheels

if TYPE_CHECKING:
    from viser import ViserServer

FELT, PILOT = (0, 158, 115), (213, 94, 0)  # colour-blind safe (Okabe & Ito 2008)
_SKY, _HAZE = (214, 226, 238), (250, 251, 252)  # background, top and bottom
# of the sphere's radius: x, y of the words on the arrows' scale, on the floor, left for the camera
_SCALE_AT = (1.7, 0.1)

_KEY = (
    '<div style="margin:2px 14px;font-size:13px"><span style="color:rgb{}">&#9650;</span> {}</div>'
)
KEY = _KEY.format(FELT, "specific force on the rider") + _KEY.format(
    PILOT, "on the pilot in the vehicle"
)
"""What the arrows are, as HTML."""


@dataclass(frozen=True, slots=True)
class Pose:
    """What is drawn of one tick.

    q_WS: orientation of the sphere.
    p_W: position of the stage in W, m.
    wheel_angle: of each wheel, rad.
    vehicle_f, felt_f: specific force of pilot and rider, m/s^2, FRD.
    contact_force, slipping: what each wheel pushes the sphere with (3, 3), N, W, and whether it
        slips (3,); None where it is not known.
    """

    q_WS: Sequence[float] | Array
    p_W: Sequence[float] | Array
    wheel_angle: Sequence[float] | Array
    vehicle_f: Sequence[float] | Array
    felt_f: Sequence[float] | Array
    contact_force: Array | None = None
    slipping: NDArray[np.bool_] | None = None

    @property
    def finite(self) -> bool:
        """Whether it can be drawn."""
        return all(
            bool(np.isfinite(part).all())
            for part in (self.q_WS, self.p_W, self.wheel_angle, self.vehicle_f, self.felt_f)
        )


class Scene:
    """The platform in a page.

    The sizes of sphere, wheels and travel are the platform's, those of other parts are made up.
    """

    def __init__(self, server: "ViserServer", platform: Platform, largest: float = USUAL) -> None:
        """Draw the platform at rest; its arrows show forces up to `largest` (g)."""
        scene, radius = server.scene, platform.sphere.radius_m
        scene.set_up_direction("+z")
        scene.set_background_image(_background(), format="png")
        scene.configure_environment_map(
            None
        )  # a picture of a room to light it is large, and the page fades in until it is there
        scene.add_light_hemisphere(
            "/light", sky_color=(255, 255, 255), ground_color=(200, 190, 180), intensity=2.2
        )
        self._stage: Stage = draw_stage(scene, platform)
        self._wheels = draw_wheels(scene, self._stage.path, platform)
        self._cabin = draw_cabin(scene, f"{self._stage.path}/cabin", platform)
        self._contacts = (
            ContactArrows(scene, self._stage.path, platform) if platform.has_loads else None
        )
        head = f"{self._stage.path}/cabin/head"
        scene.add_frame(head, show_axes=False, position=platform.head_S)
        drawn = ForceScale(radius, largest)
        self._pilot = ForceArrow(
            scene, f"{head}/pilot", drawn, 0.022 * radius, PILOT, "vehicle", "bottom-right"
        )
        self._felt = ForceArrow(
            scene, f"{head}/felt", drawn, 0.03 * radius, FELT, "rider", "bottom-left"
        )
        place = (_SCALE_AT[0] * radius, _SCALE_AT[1] * radius, self._stage.floor)
        scene.add_label("/scale", drawn.description, position=place, anchor="center-center")
        camera, middle = server.initial_camera, 0.5 * self._stage.floor
        far = 1.08 * max(2.2 * radius - middle, 3.0 * radius)
        camera.position = (0.95 * far, 1.3 * far, 0.42 * far)
        camera.look_at = (0.0, 0.0, 0.55 * middle)
        camera.fov = np.radians(45.0)

    def show(self, pose: Pose) -> None:
        """Move everything to `pose`, which must be finite."""
        self._stage.move(pose.p_W)
        self._cabin.wxyz = np.asarray(pose.q_WS)
        for (wheel, at_rest), angle in zip(self._wheels, pose.wheel_angle, strict=True):
            wheel.wxyz = multiply(at_rest, exp((0.0, 0.0, float(angle))))
        self._pilot.show(pose.vehicle_f)
        self._felt.show(pose.felt_f)
        if self._contacts and pose.contact_force is not None and pose.slipping is not None:
            self._contacts.show(pose.contact_force, pose.slipping)


def _background() -> np.ndarray:
    """Return a gradient, from the zenith down."""
    share = np.linspace(0.0, 1.0, 128)[:, None, None]
    colours = (1.0 - share) * np.array(_SKY) + share * np.array(_HAZE)
    return np.broadcast_to(colours, (128, 8, 3)).astype(np.uint8)
