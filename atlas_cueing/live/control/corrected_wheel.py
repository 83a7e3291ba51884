"""One wheel of a platform whose attitude is corrected: its schedule and what is added to it.

What moves is the SUM, so the sum keeps the wheel's limits. Its acceleration a' is chosen first
(`plant.bounded_sum`). Then the correction moves with a constant jerk beside the schedule, if the
inequalities of `guard` hold for the sum. Where they do not, since the schedule's own jerk changes
within the tick, the sum itself moves with one:

    v' = v + h (a + a') / 2,   theta' = theta + h v + h^2 (2 a + a') / 6

which always passes them. A sum that has nothing to follow flies the certified stop. Limits hold at
the ticks; between them a drive may bend by what `guard` allows to any command.
"""

# mypyc: runs every tick

from typing import Final

from ...plant.bounded_sum import SHARE, BoundedSum
from ...rotation import Vec3
from .certified_axis import AxisLimits, CertifiedStop


class CorrectedWheel:
    """The sum of schedule and correction.

    state: angle, speed and acceleration of the sum, rad, s.
    standing: whether it is at rest.
    """

    def __init__(self, limits: AxisLimits, dt: float, angle: float, share: float = SHARE) -> None:
        """Stand at `angle` (rad); tick dt in s; share of the acceleration for the correction."""
        self._limits: Final[AxisLimits] = limits
        self._sum: Final[BoundedSum] = BoundedSum(
            limits.speed, limits.acceleration, limits.jerk, share
        )
        self._dt: Final[float] = dt
        self.state: Vec3 = (angle, 0.0, 0.0)
        self._stop: CertifiedStop | None = None
        self._ticks = 0  # since the stop was planned

    @property
    def standing(self) -> bool:
        """Whether the last tick was exactly at rest."""
        return not (self.state[1] or self.state[2])

    def follow(self, before: Vec3, after: Vec3, wanted: float) -> str:
        """Go on for a tick along a schedule, with a correction towards the speed `wanted` (rad/s).

        before, after: angle, speed and acceleration of the schedule at both ends of the tick.

        Return what of the sum is not fit to follow the tick before, and stop; empty otherwise, as
        it should be whatever the schedule does.
        """
        self._stop = None
        h, (p, v, a) = self._dt, self.state
        schedule = before[1], before[2], after[2]
        new = self._sum.acceleration((v, a), schedule, wanted, h)
        own, own_after = a - before[2], new - after[2]
        beside = (
            after[0] + p - before[0] + _gain(h, v - before[1], own, own_after),
            after[1] + v - before[1] + 0.5 * h * (own + own_after),
            new,
        )
        if not self._breach(beside):
            self.state = beside
            return ""
        alone = (p + _gain(h, v, a, new), v + 0.5 * h * (a + new), new)
        breach = self._breach(alone)
        if breach:
            self.stop()
        else:
            self.state = alone
        return breach

    def stop(self) -> None:
        """Go on for a tick on the way to rest that was certified when it began."""
        if self._stop is None:
            p, v, a = self.state
            self._stop, self._ticks = self._limits.stop(p, v, a), 0
        self._ticks += 1
        self.state = self._stop.at(self._ticks * self._dt)

    def _breach(self, state: Vec3) -> str:
        """What of a state is not fit to be the next; empty when it is."""
        limits, h, (p0, v0, a0), (p, v, a) = self._limits, self._dt, self.state, state
        return limits.breach(h, p0, v0, a0, p, v, a)


def _gain(h: float, v: float, a: float, after: float) -> float:
    """The way of h (s) at speed v and an acceleration that goes evenly from a to `after`."""
    return h * v + h * h * (2.0 * a + after) / 6.0
