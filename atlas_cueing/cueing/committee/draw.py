"""The turn that keeps a cabin with the mean of some cabins, limited by what of it is felt.

With m the mean of the members' ups, d that of their rates beyond the vehicle's w, both weighted,
and e the turn that takes the cabin's own up to m:

    y_c    lambda e, at most Y_c = min(felt + rate_gain |w| + error_gain |e|, extra) long, filtered
    y      d - z + y_c, at most Y_c + sum p_i |y_i| long
    z'     y / T

The cabin turns with w + z + y, of which its rider feels y: no more than the members' riders on
average, and Y_c to come together. It has no wish of its own to be anywhere.
"""

# mypyc: runs every tick

from math import atan2

from ...rotation import ZERO, Vec3, add, cross, dot, norm, scale, subtract
from ..cabin import limited
from ..damping import DampedVector
from ..felt_turn import FeltTurnParameters
from ..tilt import fade_in

DRAW = FeltTurnParameters(response=2.0, lasting=1.0)
_AGREED = 0.1  # length of m from which on its direction begins to count (assumed), fully at twice


def turn_to(mean: Vec3, up_S: Vec3) -> Vec3:
    """Give the turn of the cabin (rotation vector, rad, S) that brings its up to the mean's.

    Where the members' ups cancel there is no direction, and the turn fades out.
    """
    axis, along = cross(mean, up_S), dot(mean, up_S)
    size = norm(axis)
    if size <= 1e-12:
        return ZERO
    return scale(fade_in(norm(mean), _AGREED) * atan2(size, along) / size, axis)


class Draw:
    """Extra rate z + y of the cabin, tick by tick: `extra` is the last one, rad/s, S."""

    def __init__(self, dt: float, parameters: FeltTurnParameters) -> None:
        """Start at rest, with a rider used to rest; dt in s."""
        self._parameters = parameters
        self._half = 0.5 * dt / parameters.canals
        self._own = DampedVector(1.0 / parameters.smoothing, dt, ZERO)
        self._felt, self._used_to, self.extra = ZERO, ZERO, ZERO

    def step(self, error: Vec3, mean: Vec3, felt: float, vehicle: Vec3) -> Vec3:
        """Give the extra rate (rad/s, S) one tick on.

        Args:
            error: turn to the members' mean up (rotation vector, rad, S).
            mean: the members' mean rate beyond the vehicle's (rad/s, S).
            felt: what the members' riders feel of theirs, mean length, rad/s.
            vehicle: rate of the vehicle as the cabin has it (rad/s, S).

        """
        bound, half = self._bound(error, vehicle), self._half
        own = self._own.step(limited(scale(self._parameters.response, error), bound))
        # z at the end of the tick is known but for the share that the new y has in it
        known = add(self._used_to, scale(half, self._felt))
        wish = scale(1.0 / (1.0 + half), subtract(add(mean, own), known))
        self._felt = limited(wish, bound + felt)
        self._used_to = add(known, scale(half, self._felt))
        self.extra = add(self._used_to, self._felt)
        return self.extra

    def _bound(self, error: Vec3, vehicle: Vec3) -> float:
        """Give the largest felt rate (rad/s) that may be added now."""
        parameters = self._parameters
        more = parameters.rate_gain * norm(vehicle) + parameters.error_gain * norm(error)
        return min(parameters.felt + more, parameters.extra)
