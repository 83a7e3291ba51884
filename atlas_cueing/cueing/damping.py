"""The critically damped second-order system: the only filter of the rotation methods."""

# mypyc: runs every tick

from math import exp

from ..rotation import ZERO, Vec3


class CriticalDamping:
    """The filter x'' = omega^2 (target - x) - 2 omega x', stepped exactly.

    The target is constant over each step.
    The kernel omega^2 t exp(-omega t) is positive and of unit area, so x never leaves the convex
    hull of its targets, and |x'| is at most omega / e times the width of that hull.
    """

    def __init__(self, omega: float, dt: float) -> None:
        """Prepare steps of dt (s) for the natural frequency omega (rad/s)."""
        decay = exp(-omega * dt)
        self._x_from_z, self._x_from_v = decay * (1.0 + omega * dt), decay * dt
        self._v_from_z, self._v_from_v = -decay * omega * omega * dt, decay * (1.0 - omega * dt)

    def step(self, x: float, v: float, target: float) -> tuple[float, float]:
        """Give the state (x, x') after one step from (x, v)."""
        z = x - target
        return (
            target + self._x_from_z * z + self._x_from_v * v,
            self._v_from_z * z + self._v_from_v * v,
        )


class DampedVector:
    """A vector behind critical damping, component by component: `x` and its rate `v`."""

    def __init__(self, omega: float, dt: float, x: Vec3) -> None:
        """Begin with the lasting vector x; omega in rad/s, dt in s."""
        self._damping = CriticalDamping(omega, dt)
        self.x, self.v = x, ZERO

    def step(self, target: Vec3) -> Vec3:
        """Give the vector one step on."""
        damping, before, rate = self._damping, self.x, self.v
        x, vx = damping.step(before[0], rate[0], target[0])
        y, vy = damping.step(before[1], rate[1], target[1])
        z, vz = damping.step(before[2], rate[2], target[2])
        self.x, self.v = (x, y, z), (vx, vy, vz)
        return self.x
