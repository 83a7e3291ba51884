"""The columns of the log's topic /loads from those of its motion."""

import numpy as np

from ..rotations import Array
from ..signals import LoadColumns
from .balance import LARGEST_USE, balance
from .model import LoadModel


def load_columns(model: LoadModel) -> LoadColumns:
    """Return the function that makes the columns (n, 15) of three wheels.

    Drive force, normal force, torque, power and traction use of each wheel; the use at most
    LARGEST_USE, so that every number is finite where the motion is.
    """

    def columns(q_WS: Array, w_WS_W: Array, alpha_WS_W: Array, a_WS_W: Array) -> Array:
        """Return the columns of n ticks."""
        with np.errstate(all="ignore"):  # a number that overflowed upstream is recorded as it is
            loads = balance(model, q_WS, w_WS_W, alpha_WS_W, a_WS_W)
            use = np.minimum(loads.traction_use, LARGEST_USE)
        return np.hstack([loads.drive, loads.normal, loads.torque, loads.power, use])

    return columns
