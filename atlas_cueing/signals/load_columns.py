"""The function that makes the numbers of /loads: of `loads`, for a recorder below it."""

from collections.abc import Callable
from typing import TypeAlias

from ..rotations import Array

LoadColumns: TypeAlias = Callable[[Array, Array, Array, Array], Array]
"""From q_WS (n, 4), w_WS_W, alpha_WS_W and a_WS_W (n, 3) to the fields of /loads but its time."""
