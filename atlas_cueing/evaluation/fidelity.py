"""How alike pilot's and rider's motion are, axis by axis, as they are and as they are perceived."""

from dataclasses import dataclass

import numpy as np

from ..perception import CANALS, OTOLITHS, Organ, Sensing
from ..rotation import ZERO, Vec3
from ..rotations import Array
from ..signals import STANDARD_GRAVITY
from .correlation import Correlation
from .cues import FORCE_THRESHOLD, RATE_THRESHOLD, CueCounter
from .run_columns import RunColumns, mean_step
from .statistics import Spread

VARIATION = 0.01
"""Standard deviation below which a signal does not vary, as a share of its axis' threshold
(assumed)."""

LEVEL = 3.0
"""Angular frequency at which a threshold is carried through an organ, rad/s (assumed): both organs
are level about it, with gains of 0.80 (otoliths) and 1.00 (canals)."""


@dataclass(frozen=True, slots=True)
class _Quantity:
    """A quantity that a head feels: specific force or angular rate.

    vehicle, platform: the columns of pilot and rider (n, 3), cabin FRD; rest: their value at rest
    upright; threshold: what a pilot begins to notice along each axis; organ: what senses it.
    """

    name: str
    unit: str
    vehicle: str
    platform: str
    rest: Vec3
    threshold: Vec3
    organ: Organ


_FORCE = _Quantity(
    "force",
    "m_s2",
    "vehicle_f_B",
    "felt_f",
    (0.0, 0.0, -STANDARD_GRAVITY),
    FORCE_THRESHOLD,
    OTOLITHS,
)
_RATE = _Quantity("rate", "rad_s", "vehicle_w_B", "felt_w", ZERO, RATE_THRESHOLD, CANALS)


class Fidelity:
    """How alike the pilot's and the rider's motion are along each axis, and as it is perceived.

    Of specific force and angular rate along x forward, y right and z down of the cabin, with names
    that begin with force_x and so on:

    - ..._correlation, ..._delay_s: peak of the cross-correlation and how late the rider's signal is
      there (`Correlation`), both 0 when one of the signals varies by no more than `VARIATION` of
      the axis' threshold;
    - ..._missing_share, ..._false_share, ..._scaled_share: shares of the ticks by kind of cue
      (`CueCounter`), of the signals less their values at rest upright.

    With perceived_force_x and so on both signals have gone through the otoliths, or the canals
    (`vestibular`), at rest in the first tick's steady state before it. The thresholds are carried
    through them as well (`LEVEL`), so that both sides are in the organ's own unit.
    perceived_force_..._m_s2 and perceived_rate_..._rad_s are the length of the error vector behind
    the organs: rms, 95 % quantile and maximum.

    Ticks are taken as evenly spaced, as far apart as those of the first block are on average.
    """

    def __init__(self) -> None:
        """Begin without ticks."""
        self._sensations: list[_Sensation] = []

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        self._sensations = self._sensations or _sensations(mean_step(block.time))
        for quantity in self._sensations:
            quantity.add(block)

    def figures(self) -> dict[str, float]:
        """Perceived errors, then likeness of each axis, of all blocks so far."""
        quantities = self._sensations or _sensations(1.0)
        figures: dict[str, float] = {}
        for part in (_Sensation.errors, _Sensation.plain, _Sensation.perceived):
            for quantity in quantities:
                figures |= part(quantity)
        return figures


class _Sensation:
    """One quantity as pilot and rider have it: likeness of its axes and perceived error."""

    def __init__(self, quantity: _Quantity, dt: float) -> None:
        self._quantity = quantity
        gain = float(np.abs(quantity.organ.response(LEVEL)))
        self._plain, self._perceived = (
            [_Likeness(level * t, dt) for t in quantity.threshold] for level in (1.0, gain)
        )
        self._pilot, self._rider = (
            [Sensing(quantity.organ, dt) for _ in range(3)] for _ in range(2)
        )
        self._error = Spread()

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        vehicle, platform = (
            getattr(block, self._quantity.vehicle),
            getattr(block, self._quantity.platform),
        )
        square = np.zeros(len(block.time))
        for i in range(3):
            pilot, rider = (
                vehicle[:, i] - self._quantity.rest[i],
                platform[:, i] - self._quantity.rest[i],
            )
            self._plain[i].add(pilot, rider)
            pilot, rider = self._pilot[i].sense(pilot), self._rider[i].sense(rider)
            self._perceived[i].add(pilot, rider)
            square += (rider - pilot) ** 2
        self._error.add(np.sqrt(square))

    def errors(self) -> dict[str, float]:
        """Length of the perceived error: rms, 95 % quantile and maximum."""
        return self._error.figures(f"perceived_{self._quantity.name}", self._quantity.unit)

    def plain(self) -> dict[str, float]:
        """Likeness of each axis, as it is."""
        return self._of_axes(self._quantity.name, self._plain)

    def perceived(self) -> dict[str, float]:
        """Likeness of each axis, behind the organ."""
        return self._of_axes(f"perceived_{self._quantity.name}", self._perceived)

    def _of_axes(self, name: str, axes: "list[_Likeness]") -> dict[str, float]:
        return {
            key: value
            for i, axis in enumerate(axes)
            for key, value in axis.figures(f"{name}_{'xyz'[i]}").items()
        }


class _Likeness:
    """Correlation and cues of two signals (n,) along one axis."""

    def __init__(self, threshold: float, dt: float) -> None:
        self._correlation, self._cues = (
            Correlation(dt, VARIATION * threshold),
            CueCounter(threshold),
        )

    def add(self, pilot: Array, rider: Array) -> None:
        """Take in the next ticks."""
        self._correlation.add(pilot, rider)
        self._cues.add(pilot, rider)

    def figures(self, name: str) -> dict[str, float]:
        """All figures of the axis, with names that begin with `name`."""
        peak, delay = self._correlation.peak()
        shares = {f"{name}_{kind}_share": share for kind, share in self._cues.shares().items()}
        return {f"{name}_correlation": peak, f"{name}_delay_s": delay, **shares}


def _sensations(dt: float) -> list[_Sensation]:
    return [_Sensation(quantity, dt) for quantity in (_FORCE, _RATE)]
