"""Sphere motion to wheel speeds, exactly as the paper's generalized kinematic model."""

from .drive import Wheels
from .geometry import LARGEST_CONDITION_NUMBER, TANGENT_TOLERANCE, Geometry, OmniWheel
from .headroom import Headroom, headroom

__all__ = [
    "LARGEST_CONDITION_NUMBER",
    "TANGENT_TOLERANCE",
    "Geometry",
    "Headroom",
    "OmniWheel",
    "Wheels",
    "headroom",
]
