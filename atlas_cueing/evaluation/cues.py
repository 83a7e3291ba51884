"""Missing, false and scaled cues: what the rider should have felt and did not, and vice versa.

The kinds are those of Grant & Reid, "Motion Washout Filter Tuning: Rules and Requirements", J.
Aircraft 34 (1997).
"""

from math import radians

import numpy as np

from ..rotation import Vec3
from ..rotations import Array

FORCE_THRESHOLD: Vec3 = (0.17, 0.17, 0.28)
"""Specific force along x, y, z that a pilot begins to notice, m/s^2.

Reid & Nahon, "Flight Simulation Motion-Base Drive Algorithms: Part 1", UTIAS Report 296 (1985). In
the laboratory, in the dark, less is found: 0.063 and 0.154 m/s^2 (Benson, Spencer & Stott,
Aviation, Space and Environmental Medicine 57, 1986).
"""

RATE_THRESHOLD: Vec3 = (radians(3.0), radians(3.6), radians(2.6))
"""Angular rate about x, y, z that a pilot begins to notice, rad/s.

The same report (3.0, 3.6 and 2.6 deg/s).
"""

GAIN_BAND = (0.8, 1.25)
"""Gains of a cue that a rider takes for one to one (assumed): the lower end is that of high
fidelity in Sinacori's criterion as used by Schroeder, NASA/TP-1999-208766; the upper end is its
reciprocal."""


class CueCounter:
    """Shares of the ticks at which a cue along one axis is missing, false or scaled.

    A cue is there when its magnitude is above the threshold. No tick is of two kinds:

    - missing: the vehicle's cue is there, the platform's is not;
    - false: the platform's is there, the vehicle's is not, or has the opposite sign;
    - scaled: both are there, with one sign, and platform over vehicle is outside `GAIN_BAND`.
    """

    def __init__(self, threshold: float) -> None:
        """Begin without ticks; `threshold` is in the unit of the signals."""
        self._threshold = threshold
        self._ticks, self._missing, self._false, self._scaled = 0, 0, 0, 0

    def add(self, vehicle: Array, platform: Array) -> None:
        """Take in the next ticks (n,) of pilot and rider, as departures from rest."""
        wanted, size = np.abs(vehicle), np.abs(platform)
        asked, given = wanted > self._threshold, size > self._threshold
        both = asked & given
        alike = both & ((vehicle > 0.0) == (platform > 0.0))
        low, high = GAIN_BAND
        scaled = alike & ((size < low * wanted) | (size > high * wanted))
        self._ticks += len(vehicle)
        self._missing += int(np.count_nonzero(asked)) - int(np.count_nonzero(both))
        self._false += int(np.count_nonzero(given)) - int(np.count_nonzero(alike))
        self._scaled += int(np.count_nonzero(scaled))

    def shares(self) -> dict[str, float]:
        """Shares, 0 to 1, of all ticks so far, by kind."""
        counts = {"missing": self._missing, "false": self._false, "scaled": self._scaled}
        return {kind: count / max(self._ticks, 1) for kind, count in counts.items()}
