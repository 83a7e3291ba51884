"""A flight that was recorded, as a vehicle."""

from collections.abc import Sequence
from itertools import pairwise
from math import ulp
from typing import Final

import numpy as np

from ..errors import InputError
from ..signals import VehicleState

# of a step: how far a state may lie from its place; times in whole us at 1000 Hz lie 1e-3 away
_IRREGULAR: Final = 0.02


class RecordedVehicle:
    """Plays states back one after the other, bit by bit as they were (implements signals.Vehicle).

    The step is the time from the first state to the second, which is exactly the step of the
    vehicle that was recorded when its first time is 0. Where that does not lead to the last state,
    since times were rounded, it is the mean.
    """

    def __init__(self, states: Sequence[VehicleState]) -> None:
        """States in order of time, at least two.

        Raises InputError when there are fewer, or time does not go on.
        """
        if len(states) < 2:
            raise InputError(
                "a recorded flight needs at least two states to know its step; this one has"
                f" {len(states)}"
            )
        for before, now in pairwise(states):
            if not now.time > before.time:
                raise InputError(
                    f"a recorded flight must go on in time: {now.time:.9g} s after"
                    f" {before.time:.9g} s"
                )
        self._states = states
        self._dt = _step([state.time for state in states])
        self._now = 0

    @property
    def dt(self) -> float:
        """Time between two states, s."""
        return self._dt

    @property
    def length(self) -> float:
        """Time from the first state to the last, s."""
        return self._states[-1].time - self._states[0].time

    def check_regular(self) -> None:
        """Refuse what cannot be flown without a clock, where every state is one step on.

        Nothing is resampled here. Raises InputError for states that are missing, or that do not lie
        on the grid of the step.
        """
        first = self._states[0].time
        for k, (before, now) in enumerate(pairwise(self._states), 1):
            off = now.time - first - k * self._dt
            if abs(off) <= _IRREGULAR * self._dt + 4.0 * ulp(now.time):
                continue
            lost = round((now.time - before.time) / self._dt) - 1
            found = (
                f"{lost} state{'s' if lost > 1 else ''} missing between {before.time:.6f} and"
                f" {now.time:.6f} s"
                if lost > 0
                else f"its states are no equal steps: {now.time:.6f} s after {before.time:.6f} s"
            )
            raise InputError(f"{found}, allowed: a state every {self._dt:.9g} s")

    @property
    def state(self) -> VehicleState:
        """The present state."""
        return self._states[self._now]

    def advance(self) -> bool:
        """Go one state on; False, and nothing changes, after the last one."""
        if self._now + 1 == len(self._states):
            return False
        self._now += 1
        return True


def _step(times: Sequence[float]) -> float:
    """The step, s, of which increasing times are multiples but for rounding.

    Gaps count as several.
    """
    first, span = times[1] - times[0], times[-1] - times[0]
    ticks = max(round(span / float(np.median(np.diff(times)))), 1)
    return first if abs(ticks * first - span) <= ticks * ulp(times[-1]) else span / ticks
