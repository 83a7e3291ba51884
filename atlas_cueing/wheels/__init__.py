"""Sphere motion to wheel speeds, exactly as the paper's generalized kinematic model."""

from .drive import Wheels
from .geometry import LARGEST_CONDITION_NUMBER, TANGENT_TOLERANCE, Geometry, OmniWheel
from .headroom import Headroom, headroom
from .rows import (
    RollerRows,
    RowEffect,
    row_contact,
    row_correction,
    row_corrections,
    row_effect,
    tilt,
)

__all__ = [
    "LARGEST_CONDITION_NUMBER",
    "TANGENT_TOLERANCE",
    "Geometry",
    "Headroom",
    "OmniWheel",
    "RollerRows",
    "RowEffect",
    "Wheels",
    "headroom",
    "row_contact",
    "row_correction",
    "row_corrections",
    "row_effect",
    "tilt",
]
