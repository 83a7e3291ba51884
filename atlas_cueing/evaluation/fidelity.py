"""How alike pilot's and rider's motion are, axis by axis, as they are and as they are perceived."""

from dataclasses import dataclass

import numpy as np

from ..rotation import ZERO, Vec3
from ..rotations import Array
from ..signals import STANDARD_GRAVITY
from .correlation import Correlation
from .cues import FORCE_THRESHOLD, RATE_THRESHOLD, CueCounter
from .run_columns import RunColumns, gathered
from .statistics import Spread
from .vestibular import CANALS, OTOLITHS, Organ, Sensing

VARIATION = 0.01
"""Standard deviation below which a signal does not vary, as a share of its axis' threshold
(assumed)."""


@dataclass(frozen=True, slots=True)
class _Quantity:
    """One of the two things felt: its name, unit and columns, value at rest, thresholds of its axes, the organ for it."""

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
    """Likeness of pilot's and rider's motion, block by block."""

    def __init__(self) -> None:
        """Of no ticks yet."""
        self._quantities: list[_Sides] = []

    def add(self, block: RunColumns) -> None:
        """Take in the ticks that follow."""
        self._quantities = self._quantities or _all_sides(_step(block.time))
        for quantity in self._quantities:
            quantity.add(block)

    def figures(self) -> dict[str, float]:
        """Those of `likeness`."""
        quantities = self._quantities or _all_sides(1.0)
        figures: dict[str, float] = {}
        for part in (_Sides.errors, _Sides.plain, _Sides.perceived):
            for quantity in quantities:
                figures |= part(quantity)
        return figures


def likeness(flight: RunColumns) -> dict[str, float]:
    """Figures of specific force and angular rate along each axis of the cabin (forward x, right y, down z), also as perceived.

    - ..._correlation and ..._delay_s: peak of the cross-correlation and how late the platform is
      there (`correlation`), both 0 when pilot's or rider's signal varies by no more than
      `VARIATION` of the threshold;
    - ..._missing_share, ..._false_share, ..._scaled_share: cues by `cue_shares`, as departures from
        rest upright.

    Names begin with force_x and so on; with perceived_force_x where both signals have gone through
    the otoliths, or the canals, at rest in the first tick's steady state before it. The thresholds
    are the same there: they are the organs', at their output. perceived_force_rms_m_s2,
        perceived_rate_rms_rad_s, ..._p95_..., ..._max_... are the error vector's length then.

    Ticks are taken as evenly spaced, as far apart as those of the first block are on average.
    """
    return gathered(Fidelity(), flight)


def _step(time: Array) -> float:
    """Mean step, s."""
    return float(time[-1] - time[0]) / (len(time) - 1) if len(time) > 1 else 1.0


class _Sides:
    """Pilot's and rider's share of one quantity."""

    def __init__(self, quantity: _Quantity, dt: float) -> None:
        self._quantity = quantity
        self._plain, self._perceived = (
            [_Alike(t, dt) for t in quantity.threshold] for _ in range(2)
        )
        self._pilot, self._rider = (
            [Sensing(quantity.organ, dt) for _ in range(3)] for _ in range(2)
        )
        self._error = Spread()

    def add(self, block: RunColumns) -> None:
        """Take in the ticks that follow."""
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
        """Of the perceived error."""
        return self._error.figures(f"perceived_{self._quantity.name}", self._quantity.unit)

    def plain(self) -> dict[str, float]:
        """Of each axis, as it is."""
        return self._of_axes(self._quantity.name, self._plain)

    def perceived(self) -> dict[str, float]:
        """Of each axis, behind the organ."""
        return self._of_axes(f"perceived_{self._quantity.name}", self._perceived)

    def _of_axes(self, name: str, axes: "list[_Alike]") -> dict[str, float]:
        return {
            key: value
            for i, axis in enumerate(axes)
            for key, value in axis.figures(f"{name}_{'xyz'[i]}").items()
        }


class _Alike:
    """Likeness of two signals along one axis."""

    def __init__(self, threshold: float, dt: float) -> None:
        self._correlation, self._cues = (
            Correlation(dt, VARIATION * threshold),
            CueCounter(threshold),
        )

    def add(self, pilot: Array, rider: Array) -> None:
        """Take in the ticks that follow."""
        self._correlation.add(pilot, rider)
        self._cues.add(pilot, rider)

    def figures(self, name: str) -> dict[str, float]:
        """With names that begin so."""
        peak, delay = self._correlation.peak()
        shares = {f"{name}_{kind}_share": share for kind, share in self._cues.shares().items()}
        return {f"{name}_correlation": peak, f"{name}_delay_s": delay, **shares}


def _all_sides(dt: float) -> list[_Sides]:
    return [_Sides(quantity, dt) for quantity in (_FORCE, _RATE)]
