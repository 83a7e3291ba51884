"""How far the rider's motion is from the pilot's, tick by tick."""

import numpy as np

from ..rotation import conjugate, from_euler, to_euler
from ..rotations import Array, geodesic, length, multiply
from ..signals import STANDARD_GRAVITY, direction_error
from .run_columns import RunColumns, gathered
from .statistics import Magnitudes, Spread, distance

DIRECTION_FORCE = 0.1 * STANDARD_GRAVITY
"""Specific force that has a direction worth comparing, m/s^2 (assumed): at a tenth of g the
smallest sideways force that is felt, 0.17 m/s^2 (`cues.FORCE_THRESHOLD`), already turns it by 10
deg."""

# (N, FRD) quaternion to (W, FLU), see rotation.flip_rotation
_FLIP = np.array([1.0, 1.0, -1.0, -1.0])


class Deviation:
    """What the rider has against what the pilot has, block by block."""

    def __init__(self) -> None:
        """Of no ticks yet."""
        # that of the vehicle at the start, taken out of its attitude
        self._heading: Array | None = None
        self._force, self._direction, self._rate, self._attitude = (
            Spread(),
            Spread(),
            Spread(),
            Spread(),
        )
        self._extra = Magnitudes()
        self._unlimited = bytearray()  # 1 or 0 a tick: whether the rate error there is extra rate

    def add(self, block: RunColumns) -> None:
        """Take in the ticks that follow."""
        if self._heading is None:
            self._heading = _heading(block.vehicle_q_NB[0])
        self._force.add(distance(block.felt_f, block.vehicle_f_B))
        self._direction.add(_directions(block.vehicle_f_B, block.felt_f))
        self._attitude.add(geodesic(_cabin(block.vehicle_q_NB, self._heading), block.motion_q_WS))
        rate, unlimited = distance(block.felt_w, block.vehicle_w_B), block.limited[:, 0] == 0.0
        self._rate.add(rate)
        self._extra.add(rate[unlimited])
        self._unlimited += unlimited.data

    def figures(self) -> dict[str, float]:
        """Those of `deviation`."""
        return {
            **self._force.figures("force", "m_s2"),
            **self._direction.figures("direction", "rad"),
            "direction_counted_share": self._direction.count / max(self._force.count, 1),
            **self._rate.figures("rate", "rad_s"),
            **self._attitude.figures("attitude", "rad"),
        }

    def extra_rate(self) -> dict[str, float]:
        """Those of `extra_rate`."""
        return {
            "extra_rate_rms_rad_s": self._extra.rms,
            "extra_rate_p99_rad_s": self._rate.quantile(
                0.99, np.frombuffer(self._unlimited, np.bool_)
            ),
            "extra_rate_max_rad_s": self._extra.largest,
        }


def deviation(flight: RunColumns) -> dict[str, float]:
    """Rms, 95 % quantile and maximum over the flight of what the rider has against what the pilot has.

    - force_..._m_s2: length of the difference of the specific forces at the head, felt - vehicle,
        cabin FRD;
    - direction_..._rad: angle between them, over the ticks at which both are larger than
      `DIRECTION_FORCE` (near free fall a force has no direction to speak of);
      direction_counted_share is the share of those ticks;
    - rate_..._rad_s: length of the difference of the angular rates, felt - vehicle, cabin FRD;
    - attitude_..._rad: angle of the rotation from the vehicle's attitude (`vehicle_attitude`) to
        the cabin's.
    """
    return gathered(Deviation(), flight)


def extra_rate(flight: RunColumns) -> dict[str, float]:
    """Cabin rate beyond the vehicle's, |felt - vehicle|, over the ticks at which the wheels are not limited.

    extra_rate_rms_rad_s, extra_rate_p99_rad_s, extra_rate_max_rad_s: what the cueing turns the
    rider on its own account, with what the actuators could not give left out; the same difference
    over all ticks is the rate error of `deviation`.
    """
    all_ticks = Deviation()
    gathered(all_ticks, flight)
    return all_ticks.extra_rate()


def vehicle_attitude(flight: RunColumns) -> Array:
    """The vehicle's attitude as an orientation of the cabin, q_WS (n, 4), with its heading at the start taken out."""
    q_NB = flight.vehicle_q_NB
    return _cabin(q_NB, _heading(q_NB[0])) if len(q_NB) else np.empty((0, 4))


def _heading(q_NB: Array) -> Array:
    """The turn (4,) that takes the heading of q_NB (4,) to north."""
    w, x, y, z = q_NB.tolist()
    return np.array(conjugate(from_euler(to_euler((w, x, y, z))[0], 0.0, 0.0)))


def _cabin(q_NB: Array, to_north: Array) -> Array:
    """Cabin orientations (n, 4) for vehicle attitudes (n, 4)."""
    attitude: Array = multiply(to_north, q_NB) * _FLIP
    return attitude


def _directions(f: Array, g: Array) -> Array:
    """Angles (rad) between forces (n, 3), of the ticks at which both are large enough to have a direction."""
    angles = direction_error(f, g)
    counted = (length(f) > DIRECTION_FORCE) & (length(g) > DIRECTION_FORCE) & ~np.isnan(angles)
    return angles if counted.all() else angles[counted]
