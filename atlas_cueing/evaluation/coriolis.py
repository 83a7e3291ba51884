"""Net turns of the cabin, and the cross-coupling that they give a nodding head."""

from math import tau

import numpy as np

from ..rotations import Array
from .run_columns import RunColumns, Tail
from .statistics import Spread

NOD = 1.0
"""Rate of the reference nod, rad/s (assumed).

30 deg, the nod of Woodman & Griffin, Aviation, Space and Environmental Medicine
68 (1997), in half a second.
"""

_AXES = ("roll", "pitch", "yaw")


class Coriolis:
    """Cross-coupling that turning gives a nodding head, and the cabin's net turns.

    - coriolis_..._rad_s2: magnitude of the angular acceleration w x n that the canals of a rider
      get, on top of the cabin's, from nodding at the rate n = `NOD` about the cabin's y while the
      cabin turns at w (cabin FRD). This is what makes head movements in a turning cabin sickening
      (Guedry & Benson, Aviation, Space and Environmental Medicine 49, 1978). It is
      NOD * sqrt(wx^2 + wz^2): turning about the nod's own axis is harmless. Rms and 95 % quantile;
    - vehicle_coriolis_..._rad_s2: the same for a pilot in the vehicle, whom the flight itself asks
      to bear it;
    - turns_roll, turns_pitch, turns_yaw: integral of the cabin's rate about its own axes x, y, z
      (FRD) in turns, with sign, by the trapezoidal rule.
    """

    def __init__(self) -> None:
        """Begin without ticks."""
        self._rider, self._pilot = Spread(), Spread()
        self._turned: Array = np.zeros(3)  # rad
        self._tail = Tail(1)

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        self._rider.add(_coriolis(block.felt_w))
        self._pilot.add(_coriolis(block.vehicle_w_B))
        time, w = self._tail.joined(block.time, block.felt_w)
        self._turned += np.einsum("i,ij->j", 0.5 * np.diff(time), w[1:] + w[:-1])

    def figures(self) -> dict[str, float]:
        """Cross-coupling and net turns of all blocks so far."""
        found: dict[str, float] = {}
        for name, exposure in (("coriolis", self._rider), ("vehicle_coriolis", self._pilot)):
            found |= {
                f"{name}_rms_rad_s2": exposure.rms,
                f"{name}_p95_rad_s2": exposure.quantile(0.95),
            }
        return found | {
            f"turns_{name}": float(turned) / tau
            for name, turned in zip(_AXES, self._turned, strict=True)
        }


def _coriolis(w: Array) -> Array:
    """Cross-coupling (n,), rad/s^2, at rates w (n, 3), rad/s, FRD."""
    exposure: Array = NOD * np.sqrt(w[:, 0] ** 2 + w[:, 2] ** 2)
    return exposure
