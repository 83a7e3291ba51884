"""The semicircular canals of three axes, tick by tick."""

# mypyc: runs every tick

from ..rotation import Vec3, add, scale
from .vestibular import CANALS, Organ


class Canals:
    """An organ of two lags that senses each component of a vector, as `Sensing` does.

    It is exact for a rate that is straight between ticks (first-order hold).
    """

    def __init__(self, dt: float, w: Vec3, organ: Organ = CANALS) -> None:
        """Begin in the steady state of the rate w (rad/s); ticks are dt (s) apart."""
        decay, drive, steady, direct = organ.discrete(dt)
        (gain_a, _), (gain_b, _) = organ.lags
        self._direct, self._gain_a, self._gain_b = direct, gain_a, gain_b
        self._decay_a, self._decay_b = float(decay[0]), float(decay[1])
        self._drive_a, self._drive_b = float(drive[0]), float(drive[1])
        # what each lag holds, without the part of the input to come
        self._a, self._b = scale(float(steady[0]), w), scale(float(steady[1]), w)

    def sense(self, w: Vec3) -> Vec3:
        """Give the sensed rate (rad/s) for the rate w of the next tick."""
        sensed = add(
            scale(self._direct, w), add(scale(self._gain_a, self._a), scale(self._gain_b, self._b))
        )
        self._a = add(scale(self._decay_a, self._a), scale(self._drive_a, w))
        self._b = add(scale(self._decay_b, self._b), scale(self._drive_b, w))
        return sensed
