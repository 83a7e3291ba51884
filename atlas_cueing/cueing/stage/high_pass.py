"""The onset of an acceleration, by a filter that no demand drives out of its bounds.

A stage of finite travel can give only the onset of a lasting demand d:

    u = d s / (s + omega_r)        p = u / (s + omega)^2        a = p''

brakes with the natural frequency omega and comes back to the centre with omega_r. The demand is
limited beforehand, by A tanh(d / A), so that no demand, by the L1 norms of the filter, can drive p,
v or a out of their bounds.
"""

# mypyc: runs every tick

from math import e, exp, pi, tanh

from ..damping import CriticalDamping


class HighPass:
    """One axis of the stage: demand (m/s^2) in, position, velocity and acceleration out."""

    def __init__(
        self, dt: float, onset: float, recentre: float, bandwidth: float, bound: float
    ) -> None:
        """Start at rest in the centre.

        Parameters as in StageParameters, for one axis; `bound` is A, m/s^2; dt in s.
        """
        self._omega, self._bound = onset, bound
        self._braking = CriticalDamping(onset, dt)
        self._pass = 1.0 - exp(-2.0 * pi * bandwidth * dt)
        self._drain = 1.0 - exp(-recentre * dt)
        self._demand = self._lasting = self._p = self._v = self._u = 0.0
        self._started = False

    def step(self, demand: float) -> tuple[float, float, float]:
        """Give position (m), velocity and acceleration after one tick, for a demand in m/s^2.

        A demand that is there at the start counts as lasting.
        """
        limited = self._bound * tanh(demand / self._bound)
        if not self._started:
            self._demand = limited
            self._lasting = limited
            self._started = True
        self._demand += self._pass * (limited - self._demand)
        self._lasting += self._drain * (self._demand - self._lasting)
        before, self._u = self._u, self._demand - self._lasting
        omega = self._omega
        self._p, self._v = self._braking.step(
            self._p, self._v, 0.5 * (before + self._u) / (omega * omega)
        )
        return self._p, self._v, self._u - omega * (2.0 * self._v + omega * self._p)

    @property
    def high_frequency(self) -> float:
        """The demand of the last step, limited and without its lasting part: u, m/s^2."""
        return self._u


def demand_bound(onset: float, travel: float, speed: float, acceleration: float) -> float:
    """Give the largest demand A (m/s^2) that keeps the filter inside travel, speed, acceleration.

    That holds for any history of the demand. |u| <= 2 A, since the lasting part of a demand within
    A is within A. The L1 norms of 1, s and s^2 over (s + omega)^2 are 1 / omega^2, 2 / (e omega)
    and 2 + 2 / e^2.
    """
    worst = (1.0 / onset**2, 2.0 / (e * onset), 2.0 + 2.0 / e**2)
    return 0.5 * min(travel / worst[0], speed / worst[1], acceleration / worst[2])
