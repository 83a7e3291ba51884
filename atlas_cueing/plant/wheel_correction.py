"""What is added to a wheel's schedule; both together keep the wheel's limits (`bounded_sum`)."""

# mypyc: runs every tick

from typing import Final

from .bounded_sum import SHARE, BoundedSum


class WheelCorrection:
    """Correction of one wheel; limits: speed rad/s, acceleration rad/s^2, jerk rad/s^3.

    share: of the acceleration limit that the correction uses for itself.
    """

    def __init__(
        self, speed: float, acceleration: float, jerk: float, share: float = SHARE
    ) -> None:
        self._sum: Final[BoundedSum] = BoundedSum(speed, acceleration, jerk, share)
        self.angle = 0.0
        self.speed = 0.0
        self.acceleration = 0.0

    def step(self, wanted: float, schedule: tuple[float, float, float], h: float) -> None:
        """Move for h (s) towards the speed `wanted` (rad/s).

        schedule: its speed and acceleration at the beginning, and acceleration at the end.
        """
        total = schedule[0] + self.speed, schedule[1] + self.acceleration
        after = self._sum.acceleration(total, schedule, wanted, h) - schedule[2]
        mean = 0.5 * (self.acceleration + after)
        self.angle += h * self.speed + h * h * (2.0 * self.acceleration + after) / 6.0
        self.speed += h * mean
        self.acceleration = after
