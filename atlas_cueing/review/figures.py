"""Metrics for people: their names in words, angles in degrees, shares in percent."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import degrees

# What a metric's name ends in, what is shown instead, factor and decimals; the first that fits
# counts.
_ENDINGS = (
    ("_rad_s2", "deg/s2", degrees(1.0), 3),
    ("_rad_s", "deg/s", degrees(1.0), 3),
    ("_rad", "deg", degrees(1.0), 3),
    ("_m_s2", "m/s2", 1.0, 3),
    ("_m_s", "m/s", 1.0, 3),
    ("_m", "m", 1.0, 4),
    ("_share", "%", 100.0, 2),
    ("duration_s", "duration s", 1.0, 2),
    ("_s", "s", 1.0, 4),
    ("ticks", "ticks", 1.0, 0),
)


@dataclass(frozen=True, slots=True)
class Figure:
    """How one metric is shown."""

    title: str
    factor: float
    decimals: int

    @classmethod
    def of(cls, name: str) -> "Figure":
        """The figure of a metric, whatever its name.

        Wheels are left in rad, as their limits are given.
        """
        for ending, unit, factor, decimals in _ENDINGS:
            if name.endswith(ending):
                in_rad = name.startswith("wheel_")
                shown = unit.replace("deg", "rad") if in_rad else unit
                words = name.removesuffix(ending).replace("_", " ")
                return cls(f"{words} {shown}".strip(), 1.0 if in_rad else factor, decimals)
        return cls(name.replace("_", " "), 1.0, 4)

    def text(self, value: float | None) -> str:
        """The value in the unit of the title; a dash for none."""
        return "-" if value is None else f"{self.factor * value:.{self.decimals}f}"


def headlines(metrics: dict[str, float]) -> list[tuple[str, str]]:
    """Title and value of what tells most."""
    return [
        (figure.title, figure.text(metrics[name]))
        for name in telling(metrics)
        for figure in [Figure.of(name)]
    ]


def telling(names: Iterable[str]) -> list[str]:
    """The metrics that tell most, each once: errors of force, direction, rate and attitude, turns, and what was limited."""
    known = list(dict.fromkeys(names))
    errors = [name for name in known if name.split("_rms_")[0] in _TELLING and "_rms_" in name]
    return errors + [
        name for name in known if name.startswith("turns_") or name.endswith("limited_share")
    ]


_TELLING = ("force", "direction", "rate", "attitude", "perceived_force", "perceived_rate")
