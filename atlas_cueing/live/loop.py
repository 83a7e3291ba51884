"""The real-time loop: one tick a period against the clock.

A tick belongs to the deadline start + slot dt. Deadlines that pass before their tick can begin are
missed: they are counted and left out, never made up by running twice. The platform's own time goes
on by dt a tick, so that its motion is even whatever the clock does; /timing keeps the real time
beside it.
"""

from collections.abc import Sequence
from math import isfinite
from typing import Protocol

from ..signals import Tick
from ..signals import Timing as TickTiming
from .clock import Clock
from .control.controller import LiveController
from .control.guard import Command
from .timing import LoopTiming

# s from a tick's deadline to the time its set point is for; what a drive may use up of it is jitter
LEAD = 0.008


class Output(Protocol):
    """Whatever keeps or shows ticks without ever making the loop wait."""

    def tick(self, tick: Tick, timing: TickTiming) -> None:
        """One tick."""

    def status(self, time: float, state: str, reason: str) -> None:
        """A change of state at `time` (s)."""


class Drives(Protocol):
    """Whatever takes commands to the drives without ever making the loop wait."""

    def send(
        self, sequence: int, time: float, valid_from: float, state: int, command: Command
    ) -> None:
        """One set point; valid_from in s of the loop's clock."""


class Loop:
    """Runs a conductor against a clock, until it is over."""

    def __init__(
        self,
        dt: float,
        clock: Clock,
        conductor: LiveController,
        outputs: Sequence[Output],
        drives: Sequence[Drives],
        origin: float | None = None,
    ) -> None:
        """Tick dt in s.

        `origin`, s of the clock, is where the log counts its real time from; the loop's start by
        default.
        """
        self._dt, self._clock, self._conductor, self._origin = dt, clock, conductor, origin
        self._outputs, self._drives = outputs, drives
        self._missed_in_a_row = 0
        self.ticks, self.time = 0, 0.0
        self.timing = LoopTiming()

    def run(self) -> None:
        """Tick on."""
        start, slot = self._clock.now() + self._dt, 0
        since = start if self._origin is None else self._origin
        while not self._conductor.over:
            deadline = start + slot * self._dt
            self._clock.sleep_until(deadline)
            begun = self._clock.now()
            slot += 1 + self._count_missed(begun - deadline)
            self._tick(deadline, deadline - start, deadline - since, begun)
        self._tell()

    def _count_missed(self, lateness: float) -> int:
        """How many whole periods too late this tick is."""
        missed = int(lateness / self._dt)
        self._missed_in_a_row = self._missed_in_a_row + missed if missed else 0
        self.timing.missed += missed
        self.timing.longest_row = max(self.timing.longest_row, self._missed_in_a_row)
        return missed

    def _tick(self, deadline: float, running: float, elapsed: float, begun: float) -> None:
        self.ticks += 1
        self.time, lateness = self.ticks * self._dt, begun - deadline
        tick, command = self._conductor.tick(self.time, running, lateness, self._missed_in_a_row)
        state = self._conductor.state.number
        for drive in self._drives:
            drive.send(self.ticks, self.time, deadline + LEAD, state, command)
        cost = self._clock.now() - begun
        self.timing.lateness.add(lateness)
        self.timing.cost.add(cost)
        age = self._conductor.intake.age
        row = TickTiming(
            self.time,
            elapsed,
            lateness,
            cost,
            age if isfinite(age) else -1.0,
            self.timing.missed,
            state,
        )
        self._tell()
        for output in self._outputs:
            output.tick(tick, row)

    def _tell(self) -> None:
        """Changes of state since the last tick, before the first tick of the new state."""
        changes = self._conductor.changes
        for state, reason in changes:
            for output in self._outputs:
                output.status(self.time, state.value, reason)
        changes.clear()
