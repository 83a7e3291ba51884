"""The canals' feeling by another rule than the package's, for tests and tools that check it."""

from atlas_cueing.rotation import ZERO, Vec3, add, scale, subtract

LASTING = 5.73  # s; of the canals (NASA/CR-2005-213747)


class Canals:
    """The canals' feeling of a rate by the bilinear rule, from rest."""

    def __init__(self, dt: float, time: float = LASTING) -> None:
        self.half = 0.5 * dt / time
        self.before = self.used_to = ZERO

    def feel(self, rate: Vec3) -> Vec3:
        half = self.half
        driven = add(scale(1.0 - half, self.used_to), scale(half, add(self.before, rate)))
        self.used_to, self.before = scale(1.0 / (1.0 + half), driven), rate
        return subtract(rate, self.used_to)
