"""The acceleration of a wheel that has a schedule and a correction, inside its limits together.

Bounded is the SUM of the two: its acceleration moves by the jerk limit a tick, stays within the
acceleration limit, and is chosen so that running it down to zero at the jerk limit ends inside the
speed limit:

    omega + h (a + a') / 2 + a'^2 / (2 J) + J h^2 / 8 <= omega_max

(the last term is what running down in whole ticks may take more). A schedule that keeps its limits
thus leaves the correction what room there is, and takes it back when it needs it.

A schedule at its jerk limit holds the acceleration a of the correction: it can then not fall before
the schedule is at its other limit, in T = (a_max + alpha) / J for a correction upwards. A loop that
does not reckon with it swings. So no more is asked for than what such a hold leaves right:

    a = (wanted - speed) / max(T, 1 / rate)
"""

# mypyc: runs every tick

from math import sqrt
from typing import Final

_JERK_SHARE: Final = 0.25  # assumed: of the jerk limit that the correction uses for itself
_RATE: Final = 20.0  # assumed: 1/s, how fast it takes up a new speed at most
SHARE: Final = 0.1  # assumed: of the acceleration limit


class BoundedSum:
    """Limits of a wheel: speed rad/s, acceleration rad/s^2, jerk rad/s^3.

    share: of the acceleration limit that the correction uses for itself.
    """

    def __init__(
        self, speed: float, acceleration: float, jerk: float, share: float = SHARE
    ) -> None:
        self._speed: Final[float] = speed
        self._acceleration: Final[float] = acceleration
        self._jerk: Final[float] = jerk
        self._calm: Final[float] = share * acceleration

    def acceleration(
        self,
        total: tuple[float, float],
        schedule: tuple[float, float, float],
        wanted: float,
        h: float,
    ) -> float:
        """Return the sum's acceleration at the end of a tick of h (s).

        Args:
            total: speed and acceleration of the sum at the beginning.
            schedule: its speed and acceleration at the beginning, and acceleration at the end.
            wanted: speed of the correction, rad/s.
            h: s.
        """
        (speed, now), most, jerk = total, self._acceleration, self._jerk
        lack, own = wanted - (speed - schedule[0]), now - schedule[1]
        held = (most + schedule[1] if lack > 0.0 else most - schedule[1]) / jerk
        aim = max(-self._calm, min(self._calm, lack / max(held, 1.0 / _RATE)))
        change = _JERK_SHARE * jerk * h
        aim = max(own - change, min(own + change, aim))
        lowest, highest = max(-most, now - jerk * h), min(most, now + jerk * h)
        highest = max(lowest, min(highest, self._allowed(speed, now, h)))
        lowest = min(highest, max(lowest, -self._allowed(-speed, -now, h)))
        return max(lowest, min(highest, aim + schedule[2]))

    def _allowed(self, speed: float, now: float, h: float) -> float:
        """The largest acceleration at the end of the tick from which the speed limit is kept."""
        jerk = self._jerk
        room = self._speed - speed - 0.5 * h * now - jerk * h * h / 8.0
        if room < 0.0:
            return 2.0 * room / h
        half = 0.5 * jerk * h
        return sqrt(half * half + 2.0 * jerk * room) - half
