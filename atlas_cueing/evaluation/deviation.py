"""How far the rider's motion is from the pilot's, tick by tick."""

import numpy as np

from ..rotation import conjugate, from_euler, to_euler
from ..rotations import Array, geodesic, length, multiply
from ..signals import STANDARD_GRAVITY, direction_error
from .run_columns import RunColumns
from .statistics import Magnitudes, Spread, distance

DIRECTION_FORCE = 0.1 * STANDARD_GRAVITY
"""Specific force that has a direction worth comparing, m/s^2 (assumed): at a tenth of g the
smallest sideways force that is felt, 0.17 m/s^2 (`cues.FORCE_THRESHOLD`), already turns it by 10
deg."""

# (N, FRD) quaternion to (W, FLU), see rotation.flip_rotation
_FLIP = np.array([1.0, 1.0, -1.0, -1.0])


class Deviation:
    """Errors of force, direction, rate and attitude: what the rider has less what the pilot has.

    Of each the rms, the 95 % quantile and the maximum over the ticks:

    - force_..._m_s2: |felt - vehicle|, specific forces at the head, cabin FRD;
    - direction_..._rad: angle between the two forces, over the ticks at which both are larger than
      `DIRECTION_FORCE` (near free fall a force has no direction to speak of);
      direction_counted_share is the share of those ticks;
    - rate_..._rad_s: |felt - vehicle|, angular rates, cabin FRD;
    - attitude_..._rad: angle of the rotation from the vehicle's attitude to the cabin's, where the
      vehicle's attitude is q_WS = flip(heading^-1 q_NB) and the heading is that of the first tick.

    The extra rate is the rate error over the ticks at which the wheels are not limited: what cueing
    turns the rider on its own account, with what the actuators could not give left out; its
    quantile is that of 99 %.
    """

    def __init__(self) -> None:
        """Begin without ticks."""
        # the turn that takes the vehicle's heading at the first tick to north
        self._to_north: Array | None = None
        self._force, self._direction = Spread(), Spread()
        self._rate, self._attitude = Spread(), Spread()
        self._extra = Magnitudes()
        self._unlimited = bytearray()  # 1 or 0 a tick: whether the rate error there is extra rate

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        if self._to_north is None:
            self._to_north = _to_north(block.vehicle_q_NB[0])
        self._force.add(distance(block.felt_f, block.vehicle_f_B))
        self._direction.add(_directions(block.vehicle_f_B, block.felt_f))
        self._attitude.add(geodesic(_cabin(block.vehicle_q_NB, self._to_north), block.motion_q_WS))
        rate, unlimited = distance(block.felt_w, block.vehicle_w_B), block.limited[:, 0] == 0.0
        self._rate.add(rate)
        self._extra.add(rate[unlimited])
        self._unlimited += unlimited.data

    def figures(self) -> dict[str, float]:
        """Errors and extra rate of all blocks so far."""
        return {
            **self._force.figures("force", "m_s2"),
            **self._direction.figures("direction", "rad"),
            "direction_counted_share": self._direction.count / max(self._force.count, 1),
            **self._rate.figures("rate", "rad_s"),
            **self._attitude.figures("attitude", "rad"),
            **self._extra_rate(),
        }

    def _extra_rate(self) -> dict[str, float]:
        counted = np.frombuffer(self._unlimited, np.bool_)
        return {
            "extra_rate_rms_rad_s": self._extra.rms,
            "extra_rate_p99_rad_s": self._rate.quantile(0.99, counted),
            "extra_rate_max_rad_s": self._extra.largest,
        }


def _to_north(q_NB: Array) -> Array:
    """Quaternion (4,) of the turn that takes the heading of q_NB (4,) to north."""
    w, x, y, z = q_NB.tolist()
    return np.array(conjugate(from_euler(to_euler((w, x, y, z))[0], 0.0, 0.0)))


def _cabin(q_NB: Array, to_north: Array) -> Array:
    """Cabin orientations (n, 4) for vehicle attitudes (n, 4)."""
    attitude: Array = multiply(to_north, q_NB) * _FLIP
    return attitude


def _directions(f: Array, g: Array) -> Array:
    """Angles (rad) between forces (n, 3), at the ticks at which both have a direction."""
    angles = direction_error(f, g)
    counted = (length(f) > DIRECTION_FORCE) & (length(g) > DIRECTION_FORCE) & ~np.isnan(angles)
    return angles if counted.all() else angles[counted]
