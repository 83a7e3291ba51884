"""What is added to a wheel's schedule, so that both together keep the wheel's limits.

Filtered is the SUM of schedule and correction: its acceleration moves by the jerk limit a tick,
stays within the acceleration limit, and is chosen so that running it down to zero at the jerk limit
ends inside the speed limit:

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


class WheelCorrection:
    """Correction of one wheel; limits: speed rad/s, acceleration rad/s^2, jerk rad/s^3.

    share: of the acceleration limit that the correction uses for itself.
    """

    def __init__(
        self, speed: float, acceleration: float, jerk: float, share: float = SHARE
    ) -> None:
        self._calm: Final[float] = share * acceleration
        self._most: Final[tuple[float, float, float]] = (speed, acceleration, jerk)
        self.angle = 0.0
        self.speed = 0.0
        self.acceleration = 0.0

    def step(self, wanted: float, schedule: tuple[float, float, float], h: float) -> None:
        """Move for h (s) towards the speed `wanted` (rad/s).

        schedule: its speed and acceleration at the beginning, and acceleration at the end.
        """
        _, most, jerk = self._most
        lack = wanted - self.speed
        held = (most + schedule[1] if lack > 0.0 else most - schedule[1]) / jerk
        aim = max(-self._calm, min(self._calm, lack / max(held, 1.0 / _RATE)))
        change = _JERK_SHARE * jerk * h
        aim = max(self.acceleration - change, min(self.acceleration + change, aim))
        speed, now = schedule[0] + self.speed, schedule[1] + self.acceleration
        lowest, highest = max(-most, now - jerk * h), min(most, now + jerk * h)
        highest = max(lowest, min(highest, self._allowed(speed, now, h)))
        lowest = min(highest, max(lowest, -self._allowed(-speed, -now, h)))
        total = max(lowest, min(highest, aim + schedule[2]))
        next_acceleration = total - schedule[2]
        mean = 0.5 * (self.acceleration + next_acceleration)
        self.angle += h * self.speed + h * h * (2.0 * self.acceleration + next_acceleration) / 6.0
        self.speed += h * mean
        self.acceleration = next_acceleration

    def _allowed(self, speed: float, now: float, h: float) -> float:
        """The largest acceleration at the end of the tick from which the speed limit is kept."""
        limit, _, jerk = self._most
        room = limit - speed - 0.5 * h * now - jerk * h * h / 8.0
        if room < 0.0:
            return 2.0 * room / h
        half = 0.5 * jerk * h
        return sqrt(half * half + 2.0 * jerk * room) - half
