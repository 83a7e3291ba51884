"""How far the rider's motion is from the pilot's, in one figure that counts what can be felt."""

from math import inf

import numpy as np

from ..perception import CANALS, Sensing
from ..rotations import Array, length
from .cues import FORCE_THRESHOLD, RATE_THRESHOLD
from .run_columns import RunColumns, mean_step
from .statistics import Magnitudes, WorstWindow, distance

FORCE_JND = FORCE_THRESHOLD[0]
"""Difference of specific force that is just noticed, m/s^2 (`cues.FORCE_THRESHOLD`, x and y): in
gravity that is 1 deg of tilt."""

RATE_JND = RATE_THRESHOLD[0]
"""Difference of angular rate that is just noticed, rad/s: 3 deg/s, about x in
`cues.RATE_THRESHOLD`. Groen & Bles, Journal of Vestibular Research 14 (2004), find the same for
the turn of a cabin that goes with moving pictures."""

WINDOW = 10.0
"""Length of the worst stretch, s (assumed)."""

MOST = 1 << 17
"""Ticks of that stretch at most: `WINDOW` up to 13 kHz. It bounds the memory for a log with any
step."""

_HALF = 1e-6  # ticks: rounding of the step does not decide on the window's last tick


class Mismatch:
    """Mismatch M of what rider and pilot feel, in just noticeable differences (JND).

    With f the specific force and w the angular rate at the head, cabin FRD, of rider r and pilot p,
    and C the semicircular canals (`vestibular.CANALS`):

        M^2 = mean |f_r - f_p|^2 / FORCE_JND^2 + mean |C(w_r - w_p)|^2 / RATE_JND^2

    So a mismatch of 1 is one just noticeable error, all the way. A rate that lasts fades as the
    canals lose it, and a force counts by its size: 10 deg of tilt at 4 g more than at 0.1 g. Since

        |f_r - f_p|^2 = (|f_r| - |f_p|)^2 + 4 |f_r| |f_p| sin^2(theta / 2)

    with theta the angle between both forces, M has three legs, and
    M^2 = mismatch_magnitude^2 + mismatch_direction^2 + mismatch_rate^2 exactly:

    - mismatch_magnitude: of the first term, the force's size. No turn of the cabin changes it;
    - mismatch_direction: of the second term, 0 where one of the forces is 0;
    - mismatch_rate: of the rates behind the canals, which begin in the steady state of the first
      difference.

    mismatch_worst_10s is the largest M of any 10 s: the worst moment of a ride tells much of
    what riders say of all of it (Kolff et al., 2024). A run shorter than that has its M there.

    Ticks are taken as evenly spaced, as far apart as those of the first block are on average.
    """

    def __init__(self) -> None:
        """Begin without ticks."""
        self._canals: list[Sensing] = []
        self._whole, self._worst = Magnitudes(), WorstWindow(MOST)
        self._magnitude, self._direction, self._rate = (Magnitudes() for _ in range(3))

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        if not self._canals:
            dt = mean_step(block.time)
            self._canals = [Sensing(CANALS, dt) for _ in range(3)]
            self._worst = WorstWindow(_window(dt))
        rate = self._sensed(block.felt_w - block.vehicle_w_B) / RATE_JND
        whole = np.hypot(distance(block.felt_f, block.vehicle_f_B) / FORCE_JND, rate)
        magnitude, direction = _legs(block.felt_f, block.vehicle_f_B)
        self._magnitude.add(magnitude / FORCE_JND)
        self._direction.add(direction / FORCE_JND)
        self._rate.add(rate)
        self._whole.add(whole)
        self._worst.add(whole * whole)

    def figures(self) -> dict[str, float]:
        """Mismatch, its legs and its worst stretch, of all blocks so far."""
        return {
            "mismatch": self._whole.rms,
            "mismatch_magnitude": self._magnitude.rms,
            "mismatch_direction": self._direction.rms,
            "mismatch_rate": self._rate.rms,
            "mismatch_worst_10s": float(np.sqrt(self._worst.mean)),
        }

    def _sensed(self, w: Array) -> Array:
        """Length (n,) of the rates w (n, 3) behind the canals, rad/s."""
        axes = [canals.sense(w[:, i]) for i, canals in enumerate(self._canals)]
        return length(np.stack(axes, axis=1))


def _window(dt: float) -> int:
    """Ticks in `WINDOW`, at least one and at most `MOST`; times of a damaged log may be any."""
    return max(round(min(WINDOW / dt - _HALF, MOST)), 1) if 0.0 < dt < inf else MOST


def _legs(f: Array, g: Array) -> tuple[Array, Array]:
    """Two legs (n,) of the difference of the forces f and g (n, 3): by size and by direction.

    The second is sqrt(|f| |g|) |f/|f| - g/|g||, which is 2 sqrt(|f| |g|) sin(theta / 2) and keeps
    its digits at small angles.
    """
    sizes = length(f), length(g)
    u, v = (
        a / np.where(size > 0.0, size, 1.0)[:, None] for a, size in zip((f, g), sizes, strict=True)
    )
    magnitude: Array = np.abs(sizes[0] - sizes[1])
    direction: Array = np.sqrt(sizes[0]) * np.sqrt(sizes[1]) * distance(u, v)
    return magnitude, direction
