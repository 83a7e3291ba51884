"""Heads and figures of the overview in words and units for people.

Degrees and percent, not radians and shares.
"""

from dataclasses import dataclass
from math import degrees, isfinite
from typing import Any

_PERCENT, _DEGREES = 100.0, degrees(1.0)
# What a name ends in, its unit, the unit shown, factor and decimals; the first that fits counts.
_ENDINGS = (
    ("_rad_s2", "rad/s²", "deg/s²", _DEGREES, 2),
    ("_rad_s", "rad/s", "deg/s", _DEGREES, 2),
    ("_rad", "rad", "deg", _DEGREES, 2),
    ("_deg_s2", "deg/s²", "deg/s²", 1.0, 2),
    ("_deg_s", "deg/s", "deg/s", 1.0, 2),
    ("_deg", "deg", "deg", 1.0, 2),
    ("_m_s3", "m/s³", "m/s³", 1.0, 2),
    ("_m_s2", "m/s²", "m/s²", 1.0, 3),
    ("_m_s", "m/s", "m/s", 1.0, 3),
    ("_m", "m", "m", 1.0, 4),
    ("_share", "", "%", _PERCENT, 1),
    ("_hz", "Hz", "Hz", 1.0, 1),
    ("_s", "s", "s", 1.0, 2),
)
_SIGNIFICANT = 5  # digits of a number without a known unit, and of one that a user set


@dataclass(frozen=True, slots=True)
class Heading:
    """A column: its name in words, the unit shown ("" for none), factor to it, decimals (None: significant digits)."""

    words: str
    unit: str = ""
    factor: float = 1.0
    decimals: int | None = None

    @classmethod
    def of_metric(cls, name: str) -> "Heading":
        """The heading of a metric, whatever its name.

        Wheels are left in rad, as their limits are given.
        """
        for ending, unit, shown, factor, decimals in _ENDINGS:
            if name.endswith(ending):
                as_is = name.startswith("wheel_")
                return cls(
                    _words(name.removesuffix(ending)),
                    unit if as_is else shown,
                    1.0 if as_is else factor,
                    decimals,
                )
        return cls(_words(name))

    @classmethod
    def of_key(cls, key: str) -> "Heading":
        """The heading of a scenario's dotted key: its last part, and the value as it was set."""
        name = key.rpartition(".")[2]
        for ending, unit, *_ in _ENDINGS:
            if unit and name.endswith(ending):
                return cls(_words(name.removesuffix(ending)), unit)
        return cls(_words(name))

    @property
    def line(self) -> str:
        """Words and unit in one line."""
        return f"{self.words}, {self.unit}" if self.unit else self.words

    def text(self, value: Any) -> str:
        """The value in the unit shown; a dash for none and for what is no number, names as they are."""
        if value is None or (isinstance(value, float) and not isfinite(value)):
            return "–"
        if isinstance(value, bool) or not isinstance(value, int | float):
            return str(value)
        if self.decimals is None:
            return f"{value:.{_SIGNIFICANT}g}" if isinstance(value, float) else str(value)
        return f"{self.factor * value:.{self.decimals}f}"


def length_of(time: float) -> str:
    """A time in s as hours, minutes or seconds, whichever reads best."""
    if time >= 3600.0:
        return f"{time / 3600.0:.1f} h"
    return f"{time / 60.0:.1f} min" if time >= 60.0 else f"{time:.1f} s"


def _words(name: str) -> str:
    return name.replace("_", " ").strip()
