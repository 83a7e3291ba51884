"""Native FDM packets by name of their fields.

They follow the whole layout, and not what the decoder reads of it.
"""

from collections.abc import Sequence
from math import cos, sin, tan
from struct import pack

LAYOUT = ">II3d6f11f3f2fI4I36fI4fI3I9fIif10f"  # net_fdm.hxx of FlightGear, version 24

Three = Sequence[float]


def packet(
    *,
    version: int = 24,
    position: Three = (0.2, 0.8, 1000.0),
    height: float = 900.0,
    euler: Three = (0.0, 0.0, 0.0),
    euler_rates: Three = (0.0, 0.0, 0.0),
    force: Three = (0.0, 0.0, -32.174),
    other: float = 7.0,
) -> bytes:
    """A packet, by position, attitude, rates and force.

    Longitude and latitude (rad, m), height (m), angles phi, theta, psi (rad) and rates,
    force (ft/s^2).

    `other` is in every float that is not of interest here.
    """
    floats = [height, *euler, other, other, *euler_rates, *[other] * 8, *force, *[other] * 2]
    engines = [*[1] * 5, *[other] * 36, 3, *[other] * 4]
    rest = [*[1] * 4, *[other] * 9, 5, -1, *[other] * 11]
    return pack(LAYOUT, version, 0, *position, *floats, *engines, *rest)


def euler_rates(euler: Three, body: Three) -> tuple[float, float, float]:
    """Rates of phi, theta, psi from body rates p, q, r.

    The inverse of what a decoder does, by the textbook's own matrix.
    """
    phi, theta, _ = euler
    p, q, r = body
    turn = q * sin(phi) + r * cos(phi)
    return (p + turn * tan(theta), q * cos(phi) - r * sin(phi), turn / cos(theta))
