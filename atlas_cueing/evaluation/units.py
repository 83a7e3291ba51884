"""Units: how numbers in SI, rad or shares are shown to people.

Names in this project end in the unit of their number (`force_rms_m_s2`, `align_rate_deg_s`), but
people are shown degrees and percent. The units and their conversions are defined here only.
"""

from dataclasses import dataclass
from math import degrees, isfinite
from typing import Any


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of a number in a log or scenario, and the one in which it is shown.

    ending: end of the names of numbers in this unit, "" for a number without one;
    symbol: the unit itself; shown: the unit that people are shown, both in ASCII;
    factor: number shown per number in the unit; decimals: digits shown behind the point.
    """

    ending: str
    symbol: str
    shown: str
    factor: float = 1.0
    decimals: int = 3

    def text(self, value: Any, missing: str = "-") -> str:
        """The value in the unit shown; `missing` for None, text and truth values as they are."""
        if value is None:
            return missing
        if isinstance(value, bool) or not isinstance(value, int | float):
            return str(value)
        return f"{self.factor * value:.{self.decimals}f}"


_DEGREES = degrees(1.0)

NUMBER = Unit("", "", "", decimals=4)
JND = Unit("", "JND", "JND", decimals=2)
"""Just noticeable differences: a ratio to a threshold, so that names do not end in it."""
COUNT = Unit("", "", "", decimals=0)
RAD = Unit("rad", "rad", "deg", _DEGREES)
RAD_S = Unit("rad_s", "rad/s", "deg/s", _DEGREES)
RAD_S2 = Unit("rad_s2", "rad/s2", "deg/s2", _DEGREES)
WHEEL_RAD_S = Unit("rad_s", "rad/s", "rad/s")
"""Rates of wheels are shown in rad/s, the unit in which their limits are given."""
WHEEL_RAD_S2 = Unit("rad_s2", "rad/s2", "rad/s2")
M = Unit("m", "m", "m", decimals=4)
M_S = Unit("m_s", "m/s", "m/s")
M_S2 = Unit("m_s2", "m/s2", "m/s2")
M_S3 = Unit("m_s3", "m/s3", "m/s3")
N = Unit("n", "N", "N", decimals=0)
N_M = Unit("n_m", "N m", "N m", decimals=1)
W = Unit("w", "W", "W", decimals=0)
J = Unit("j", "J", "J", decimals=0)
SHARE = Unit("share", "", "%", 100.0, 2)
S = Unit("s", "s", "s", decimals=4)
DURATION = Unit("s", "s", "s", decimals=2)
"""Lengths of runs, for which hundredths of a second are enough."""

_OF_KEYS = (
    *(RAD_S2, RAD_S, RAD, M_S3, M_S2, M_S, M),
    Unit("deg_s2", "deg/s2", "deg/s2"),
    Unit("deg_s", "deg/s", "deg/s"),
    Unit("deg", "deg", "deg"),
    Unit("hz", "Hz", "Hz"),
    S,
)
_SIGNIFICANT = 5  # digits of a setting


def key_in_words(key: str) -> tuple[str, str]:
    """Words for the last part of a scenario's dotted key, and the symbol of its unit or ""."""
    name = key.rpartition(".")[2]
    for unit in _OF_KEYS:
        if name.endswith(f"_{unit.ending}"):
            return in_words(name.removesuffix(f"_{unit.ending}")), unit.symbol
    return in_words(name), ""


def setting_text(value: Any) -> str:
    """The value of a scenario's key as it was set, a number with five digits at most."""
    return f"{value:.{_SIGNIFICANT}g}" if isinstance(value, float) else str(value)


def in_words(name: str) -> str:
    """A name of this project as words."""
    return name.replace("_", " ").strip()


def typeset(symbol: str) -> str:
    """The symbol of a unit with its exponents raised: m/s2 as m/s²."""
    return symbol.replace("s2", "s²").replace("s3", "s³")


def is_number(value: Any) -> bool:
    """Whether the value is a finite number; a truth value is not."""
    return isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)
