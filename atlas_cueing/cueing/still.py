"""Method `still`: the cabin stands upright and does not turn, as a mark for all others."""

# mypyc: runs every tick

from dataclasses import dataclass

from ..rotation import IDENTITY, ZERO, Quat, Vec3
from ..signals import VehicleState
from .method import Method


@dataclass(frozen=True, slots=True)
class StillParameters:
    """Parameters of `still`, which has none."""

    def rotation(self, dt: float) -> "StillRotation":  # noqa: ARG002 - as every method
        """Make the rotation that stands; dt in s."""
        return StillRotation()


class StillRotation:
    """The cabin's axes are those of W, for ever; the stage alone moves the rider."""

    def step(self, vehicle: VehicleState) -> tuple[Quat, Vec3]:  # noqa: ARG002 - as every method
        """Give orientation q_WS, which is upright, and rate w_WS_W (rad/s), which is zero."""
        return IDENTITY, ZERO


METHOD = Method(
    "still",
    "the cabin stands upright and does not turn, as a mark for all others",
    StillParameters(),
    (),
)
