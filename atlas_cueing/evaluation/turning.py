"""What turning does to the rider: net turns and cross-coupling."""

from math import tau

import numpy as np

from .flight import Array, Flight
from .statistics import quantile, rms

NOD = 1.0
"""Rate of the reference nod, rad/s (assumed): 30 deg, the nod of Woodman & Griffin, Aviation, Space and Environmental Medicine
68 (1997), in half a second."""


def turning(flight: Flight) -> dict[str, float]:
    """Coriolis exposure of rider and pilot, and the cabin's net turns.

    - coriolis_rms_rad_s2, coriolis_p95_rad_s2: magnitude of the angular acceleration w x n that the canals of a rider get, on
      top of the cabin's, from nodding at the rate n = `NOD` about the cabin's y while the cabin turns at w. This cross-coupling
      is what makes head movements in a turning cabin sickening (Guedry & Benson, Aviation, Space and Environmental Medicine
      49, 1978); it is NOD * sqrt(wx^2 + wz^2), turning about the nod's own axis is harmless;
    - vehicle_coriolis_...: the same for a pilot in the vehicle: what the mission asks for anyway;
    - turns_roll, turns_pitch, turns_yaw: net turns of the cabin about its own axes, forward-right-down, with sign.
    """
    return {
        **_coriolis("coriolis", flight.felt_w),
        **_coriolis("vehicle_coriolis", flight.vehicle_w_B),
        **_turns(flight),
    }


def _coriolis(name: str, w: Array) -> dict[str, float]:
    exposure = NOD * np.hypot(w[:, 0], w[:, 2])
    return {f"{name}_rms_rad_s2": rms(exposure), f"{name}_p95_rad_s2": quantile(exposure, 0.95)}


def _turns(flight: Flight) -> dict[str, float]:
    names = ("roll", "pitch", "yaw")
    return {f"turns_{name}": float(np.trapezoid(flight.felt_w[:, i], flight.time)) / tau for i, name in enumerate(names)}
