"""Units in which others record, as factors to SI and rad; and the unit that a header names."""

import re
from typing import Final, Literal, TypeAlias

from ..signals import STANDARD_GRAVITY

Quantity: TypeAlias = Literal["time", "force", "rate", "angle"]

_FOOT = 0.3048  # m, the international foot, exactly
_DEGREE = 0.017453292519943295  # rad

UNITS: Final[dict[Quantity, dict[str, float]]] = {
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0},
    "force": {
        "m/s2": 1.0,
        "g": STANDARD_GRAVITY,
        "mg": 1e-3 * STANDARD_GRAVITY,
        "ft/s2": _FOOT,
        "cm/s2": 0.01,
    },
    "rate": {"rad/s": 1.0, "deg/s": _DEGREE, "mrad/s": 1e-3, "rpm": 6.0 * _DEGREE},
    "angle": {"rad": 1.0, "deg": _DEGREE, "mrad": 1e-3},
}
# as they are written elsewhere; `^`, blanks and case are left out before
_SPELLINGS = {
    "sec": "s",
    "seconds": "s",
    "msec": "ms",
    "usec": "us",
    "µs": "us",
    "nsec": "ns",
    "m/s/s": "m/s2",
    "m_s2": "m/s2",
    "m/s²": "m/s2",
    "m/sec2": "m/s2",
    "ft/s/s": "ft/s2",
    "ft/sec2": "ft/s2",
    "ft_sec2": "ft/s2",
    "g's": "g",
    "gs": "g",
    "rad/sec": "rad/s",
    "rad_s": "rad/s",
    "rad_sec": "rad/s",
    "deg/sec": "deg/s",
    "deg_s": "deg/s",
    "deg_sec": "deg/s",
    "dps": "deg/s",
    "°/s": "deg/s",
    "°": "deg",
    "degrees": "deg",
    "radians": "rad",
}
# `P (deg/s)`, `ax [m/s^2]`, `velocities/p-rad_sec`, `wx_rad_s`
_IN_BRACKETS = re.compile(r"[(\[]([^()\[\]]+)[)\]]\s*$")
_AT_THE_END = re.compile(
    r"[-_](rad_sec|deg_sec|rad_s|deg_s|ft_sec2|m_s2|sec|rad|deg|s|ms|us|ns|g)$"
)


def spelt(unit: str) -> str:
    """Return a unit as `UNITS` spells it, or as it was found."""
    plain = unit.strip().lower().replace("^", "").replace(" ", "")
    return _SPELLINGS.get(plain, plain)


def factor(unit: str, quantity: Quantity) -> float | None:
    """Return what a number in this unit is multiplied with; None for a unit of something else."""
    return UNITS[quantity].get(spelt(unit))


def unit_in(header: str) -> str | None:
    """Return the unit at the end of a column's name, in brackets or after a dash; None without."""
    found = _IN_BRACKETS.search(header) or _AT_THE_END.search(header)
    return found[1] if found else None
