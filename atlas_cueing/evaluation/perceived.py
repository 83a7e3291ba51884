"""How far what the rider perceives of tilt and turn is from what the pilot perceives."""

from math import inf, nan

import numpy as np

from ..perception import Observer
from ..rotations import Array
from .run_columns import RunColumns, mean_step
from .statistics import Magnitudes, distance

STEP = 1.0 / 60.0
"""Time from one step of the observers to the next, s (assumed): a small part of the time in which
a force draws `up`, 3 (1 - Ka) / (3 Kf + Kfw) = 1.125 s. Faster ticks are averaged, so that a run
costs no more at 1 kHz than at 60 Hz."""

MOST = 1 << 12
"""Ticks in a step at most: `STEP` up to 245 kHz. It bounds the memory for a log with any step."""

LARGEST = 1e9
"""Force (m/s^2) and rate (rad/s) up to which there is a perception; beyond there is no number."""

_HALF = 1e-6  # ticks: rounding of the step does not decide on the last tick of a step


class Perceived:
    """A second opinion on a ride: what an observer makes of it in the pilot's and the rider's head.

    Both heads are those of `perception.Observer`, in the dark. With u the up that each perceives
    and w^ the rate, in axes of its own head, FRD:

    - perceived_tilt_rms_rad: rms of the angle between u of the rider and u of the pilot;
    - perceived_turn_rms_rad_s: rms of |w^_r - w^_p|.

    The observers go by steps of whole ticks, at most `STEP` unless a tick is longer, of whose
    forces and rates they get the means; both begin at rest with the first. Ticks are taken as
    evenly spaced, as far apart as those of the first block are on average. A run with numbers
    beyond `LARGEST` has NaN.
    """

    def __init__(self) -> None:
        """Begin without ticks."""
        self._ticks, self._dt = 0, 0.0  # in a step; of a step, s
        self._kept: Array = np.empty((0, 12))
        self._heads: tuple[Observer, Observer] | None = None
        self._tilt, self._turn = Magnitudes(), Magnitudes()
        self._lost = False

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks."""
        if not self._ticks:
            self._begin(mean_step(block.time))
        pilot, rider = (block.vehicle_f_B, block.vehicle_w_B), (block.felt_f, block.felt_w)
        motion = np.concatenate([self._kept, np.concatenate([*pilot, *rider], axis=1)])
        whole = len(motion) - len(motion) % self._ticks
        self._kept = motion[whole:]
        means = _means(motion[:whole], self._ticks)
        self._lost = self._lost or not bool(np.all(np.abs(means) <= LARGEST))  # NaN is lost, too
        if len(means) and not self._lost:
            self._perceive(means)

    def figures(self) -> dict[str, float]:
        """Difference of the perceived tilts and turns, of all blocks so far."""
        return {
            "perceived_tilt_rms_rad": nan if self._lost else self._tilt.rms,
            "perceived_turn_rms_rad_s": nan if self._lost else self._turn.rms,
        }

    def _begin(self, dt: float) -> None:
        """Settle how many ticks of dt (s) a step has; times of a damaged log may be any."""
        self._lost = not 0.0 < dt < inf
        self._ticks = 1 if self._lost else max(int(min(STEP / dt + _HALF, MOST)), 1)
        self._dt = self._ticks * dt

    def _perceive(self, means: Array) -> None:
        """Take the observers through the steps `means` (n, 12): f and w of pilot and of rider."""
        motions = [means[:, :6].ravel().tolist(), means[:, 6:].ravel().tolist()]
        perceived: list[list[float]] = [[], []]
        if self._heads is None:  # the first step only starts them
            self._heads = self._started(motions[0][:6]), self._started(motions[1][:6])
            perceived = [[*head.up, *head.rate] for head in self._heads]
            motions = [motion[6:] for motion in motions]
        for head, motion, found in zip(self._heads, motions, perceived, strict=True):
            found += head.follow(motion)
        # np.array would look at each number for its kind
        pilot, rider = (np.fromiter(found, np.float64).reshape(-1, 6) for found in perceived)
        apart = distance(pilot[:, :3], rider[:, :3])
        together = distance(pilot[:, :3], -rider[:, :3])
        self._tilt.add(2.0 * np.arctan2(apart, together))
        self._turn.add(distance(pilot[:, 3:], rider[:, 3:]))

    def _started(self, row: list[float]) -> Observer:
        """Give an observer that begins with force and rate, six numbers."""
        fx, fy, fz, wx, wy, wz = row
        return Observer(self._dt, (fx, fy, fz), (wx, wy, wz))


def _means(motion: Array, ticks: int) -> Array:
    """Means (n / ticks, 12) of so many rows of motion (n, 12) each, added one after the other."""
    total = motion[::ticks].copy()
    for tick in range(1, ticks):
        total += motion[tick::ticks]
    return total / ticks
