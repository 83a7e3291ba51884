"""What drives and stage are told between two ticks: polynomials of the time since the first.

A log has speed and acceleration at its ticks; between them the cubic that has both at both ends
(Hermite) is flown, so that its integral is exact.
"""

# mypyc: runs every tick

from dataclasses import dataclass

from ..rotation import Vec3

Cubic = tuple[float, float, float, float]  # c0 + c1 t + c2 t^2 + c3 t^3


@dataclass(frozen=True, slots=True)
class DriveCommand:
    """Between two ticks.

    wheels: speeds, rad/s. stage: velocity along x, y, z of W, m/s. torque: given ahead to the
    drives at the first tick, N m, and torque_rate its change, N m/s.
    """

    wheels: tuple[Cubic, Cubic, Cubic]
    stage: tuple[Cubic, Cubic, Cubic]
    torque: Vec3
    torque_rate: Vec3


def hermite(v0: float, a0: float, v1: float, a1: float, h: float) -> Cubic:
    """The cubic with value v0 and slope a0 at 0, v1 and a1 at h."""
    mean = (v1 - v0) / h
    return (v0, a0, (3.0 * mean - 2.0 * a0 - a1) / h, (a0 + a1 - 2.0 * mean) / (h * h))


def plus(a: Cubic, b: Cubic) -> Cubic:
    """Sum of two cubics."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3])


def value(c: Cubic, t: float) -> float:
    """The cubic at t."""
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]))


def slope(c: Cubic, t: float) -> float:
    """Its derivative at t."""
    return c[1] + t * (2.0 * c[2] + t * 3.0 * c[3])


def integral(c: Cubic, t: float) -> float:
    """Its integral from 0 to t."""
    return t * (c[0] + t * (c[1] / 2.0 + t * (c[2] / 3.0 + t * c[3] / 4.0)))
