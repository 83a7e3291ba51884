"""One wheel of a platform whose attitude is corrected: its schedule and what is added to it.

The SUM is what moves, so the sum is what is made here, tick by tick with a constant jerk:

    a' = a_s' + the correction's own acceleration, as far as the sum allows
    v' = v + h (a + a') / 2,   theta' = theta + h v + h^2 (2 a + a') / 6

and the correction is sum less schedule. a' moves by J h a tick, stays within A, and is one from
which running down at the jerk J ends inside the speed V:

    v + h (a + a') / 2 + a'^2 / (2 J) <= V - J h^2 / 8

(the last term is what running down in whole ticks may take more). So the sum keeps the wheel's
limits whatever the schedule does, and passes the inequalities of `guard`.

A sum that has nothing to follow flies the certified stop from where it is.
"""

# mypyc: runs every tick

from math import sqrt
from typing import Final

from ...rotation import Vec3
from .certified_axis import AxisLimits, CertifiedStop

_SHARE: Final = 0.25  # assumed: of acceleration and jerk that the correction uses for itself
_RATE: Final = 10.0  # assumed: 1/s, how fast it takes up a new speed


class CorrectedWheel:
    """The sum of schedule and correction.

    state: angle, speed and acceleration of the sum, rad, s.
    standing: whether it is at rest.
    """

    def __init__(self, limits: AxisLimits, dt: float, angle: float) -> None:
        """Stand at `angle` (rad); tick dt in s."""
        self._limits: Final[AxisLimits] = limits
        self._dt: Final[float] = dt
        self.state: Vec3 = (angle, 0.0, 0.0)
        self._stop: CertifiedStop | None = None
        self._ticks = 0  # since the stop was planned

    @property
    def standing(self) -> bool:
        """Whether the last tick was exactly at rest."""
        return not (self.state[1] or self.state[2])

    def follow(self, before: Vec3, after: Vec3, wanted: float) -> None:
        """Go on for a tick along a schedule, with a correction towards the speed `wanted` (rad/s).

        before, after: angle, speed and acceleration of the schedule at both ends of the tick.
        """
        self._stop = None
        h, (p, v, a) = self._dt, self.state
        jerk, most = self._limits.jerk, self._limits.acceleration
        calm, change = _SHARE * most, _SHARE * jerk * h
        aim = max(-calm, min(calm, _RATE * (wanted - (v - before[1]))))
        own = a - before[2]
        aim = max(own - change, min(own + change, aim))
        lowest, highest = max(-most, a - jerk * h), min(most, a + jerk * h)
        highest = max(lowest, min(highest, self._allowed(v, a)))
        lowest = min(highest, max(lowest, -self._allowed(-v, -a)))
        total = max(lowest, min(highest, after[2] + aim))
        place = p + h * v + h * h * (2.0 * a + total) / 6.0
        self.state = (place, v + 0.5 * h * (a + total), total)

    def stop(self) -> None:
        """Go on for a tick on the way to rest that was certified when it began."""
        if self._stop is None:
            p, v, a = self.state
            self._stop, self._ticks = self._limits.stop(p, v, a), 0
        self._ticks += 1
        self.state = self._stop.at(self._ticks * self._dt)

    def _allowed(self, speed: float, now: float) -> float:
        """The largest acceleration at the end of the tick from which the speed limit is kept."""
        h, jerk = self._dt, self._limits.jerk
        room = self._limits.speed - speed - 0.5 * h * now - jerk * h * h / 8.0
        if room < 0.0:
            return 2.0 * room / h
        half = 0.5 * jerk * h
        return sqrt(half * half + 2.0 * jerk * room) - half
