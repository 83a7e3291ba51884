"""Passive wheels on springs, and constant preloads: what else touches the sphere.

Each support pushes with n = max(0, n_0 + k u . d + c u . d'). As long as none can have opened they
are one linear spring and damper, which is what costs little: that is certain while the centre is
nearer to where it was tuned than the least pressed support is deep, |d - d_0| + |d'| c / k < rho.
"""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Final

from ..rotation import Mat3, Vec3, apply, dot


@dataclass(frozen=True, slots=True)
class PassiveContact:
    """A support: unit vector u (W), stiffness N/m, damping N s/m, force n_0 with d = 0, N."""

    contact: Vec3
    stiffness: float
    damping: float
    unloaded: float

    def elastic(self, d: Vec3) -> float:
        """Force of its spring, N; 0 where it has opened."""
        force = self.unloaded + self.stiffness * dot(self.contact, d)
        return max(0.0, force)

    def normal(self, d: Vec3, d_rate: Vec3) -> float:
        """Its force on the sphere, N, against u."""
        force = self.elastic(d)
        if force == 0.0:
            return 0.0
        force += self.damping * dot(self.contact, d_rate)
        return max(0.0, force)


class PassiveContacts:
    """All supports together, and the constant force of the preloads (W, N)."""

    def __init__(self, supports: Sequence[PassiveContact], preload: Vec3) -> None:
        self._supports: Final[tuple[PassiveContact, ...]] = tuple(supports)
        self.preload: Final[Vec3] = preload
        self.stiffness: Final[float] = sum(s.stiffness for s in supports)  # N/m, of all
        self._stiffness: Final[Mat3] = _tensor([s.stiffness for s in supports], supports)
        self._damping: Final[Mat3] = _tensor([s.damping for s in supports], supports)
        unloaded = [0.0, 0.0, 0.0]
        for support in supports:
            for axis in range(3):
                unloaded[axis] += support.unloaded * support.contact[axis]
        self._unloaded: Final[Vec3] = (unloaded[0], unloaded[1], unloaded[2])
        self._lag: Final[float] = max((s.damping / s.stiffness for s in supports), default=0.0)
        self._tuned: Vec3 = (0.0, 0.0, 0.0)
        self._depth = -1.0  # m; negative: nothing is certain

    def tune(self, d: Vec3) -> None:
        """Expect the centre near d (m, W)."""
        self._tuned = d
        self._depth = min((s.elastic(d) / s.stiffness for s in self._supports), default=1e300)

    def force(self, d: Vec3, d_rate: Vec3) -> tuple[Vec3, float]:
        """Force on the sphere, N, W, preload included, and the power lost in damping, W."""
        px, py, pz = self.preload
        if not self._supports:
            return self.preload, 0.0
        if self._all_touch(d, d_rate):
            k, c, n = apply(self._stiffness, d), apply(self._damping, d_rate), self._unloaded
            force = (px - k[0] - c[0] - n[0], py - k[1] - c[1] - n[1], pz - k[2] - c[2] - n[2])
            return force, dot(c, d_rate)
        lost = 0.0
        for support in self._supports:
            n_j, u, rate = support.normal(d, d_rate), support.contact, dot(support.contact, d_rate)
            px, py, pz = px - n_j * u[0], py - n_j * u[1], pz - n_j * u[2]
            lost += (n_j - support.elastic(d)) * rate
        return (px, py, pz), lost

    def energy(self, d: Vec3) -> float:
        """Energy in the springs and above the preloads, J."""
        stored = sum(s.elastic(d) ** 2 / (2.0 * s.stiffness) for s in self._supports)
        return stored - dot(self.preload, d)

    def _all_touch(self, d: Vec3, d_rate: Vec3) -> bool:
        x, y, z = d[0] - self._tuned[0], d[1] - self._tuned[1], d[2] - self._tuned[2]
        return sqrt(x * x + y * y + z * z) + self._lag * sqrt(dot(d_rate, d_rate)) < self._depth


def _tensor(weights: Sequence[float], supports: Sequence[PassiveContact]) -> Mat3:
    """Sum of k u u^T."""
    rows = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    for k, support in zip(weights, supports, strict=True):
        for i in range(3):
            for j in range(3):
                rows[i][j] += k * support.contact[i] * support.contact[j]
    a, b, c = rows
    return ((a[0], a[1], a[2]), (b[0], b[1], b[2]), (c[0], c[1], c[2]))
