"""The critically damped second-order system: the one filter of cueing."""

from math import exp


def critically_damped(x: float, v: float, target: float, omega: float, dt: float) -> tuple[float, float]:
    """State (x, x') after dt s of x'' = omega^2 (target - x) - 2 omega x', exact for a constant target.

    The kernel omega^2 t exp(-omega t) is positive and of unit area, so x never leaves the convex hull of its targets, and
    |x'| is at most omega / e times the width of that hull.
    """
    z = x - target
    decay = exp(-omega * dt)
    return target + decay * (z + (v + omega * z) * dt), decay * (v - omega * (v + omega * z) * dt)
