"""The real-time loop: one tick a period against the clock.

A tick belongs to the deadline start + slot dt. Deadlines that pass before their tick can begin are
missed: they are counted and left out, never made up by running twice. The platform's own time goes
on by dt a tick, so that its motion is even however late the ticks are; /timing keeps the real time
beside it.
"""

from collections.abc import Sequence
from math import isfinite
from typing import Protocol

from ..signals import Tick
from ..signals import Timing as TickTiming
from .clock import Clock
from .control.command import Command
from .control.controller import LiveController
from .timing import LoopTiming

# s from a tick's deadline to the time its set point is for; what a drive may use up of it is jitter
LEAD = 0.008


class Output(Protocol):
    """Keeps or shows ticks without ever making the loop wait."""

    def tick(self, tick: Tick, timing: TickTiming) -> None:
        """Take one tick."""

    def status(self, time: float, state: str, reason: str) -> None:
        """Take a change of state at `time` (s)."""


class Drives(Protocol):
    """Takes commands to the drives without ever making the loop wait."""

    def send(
        self, sequence: int, time: float, valid_from: float, state: int, command: Command
    ) -> None:
        """Take one set point.

        Args:
            sequence: number of the tick, from 1.
            time: of the platform, s.
            valid_from: when the command is due, s of the loop's clock.
            state: place of the state in signals.LIVE_STATES.
            command: motion of the drives.
        """


class Loop:
    """Runs a controller against a clock until the run is over.

    ticks: number of ticks up to now.
    time: of the platform in the last tick, s.
    timing: punctuality of the loop up to now.
    """

    def __init__(
        self,
        dt: float,
        clock: Clock,
        controller: LiveController,
        outputs: Sequence[Output],
        drives: Sequence[Drives],
        origin: float | None = None,
    ) -> None:
        """Set up; nothing runs yet.

        Args:
            dt: tick, s.
            clock: of the deadlines.
            controller: makes the ticks.
            outputs: take every tick and every change of state.
            drives: take every command.
            origin: s of the clock that the log counts its real time from; the loop's start by
                default.
        """
        self._dt = dt
        self._clock = clock
        self._controller = controller
        self._outputs = outputs
        self._drives = drives
        self._origin = origin
        self._missed_in_a_row = 0
        self.ticks, self.time = 0, 0.0
        self.timing = LoopTiming()

    def run(self) -> None:
        """Tick until the controller's run is over."""
        start, slot = self._clock.now() + self._dt, 0
        origin = start if self._origin is None else self._origin
        while not self._controller.over:
            deadline = start + slot * self._dt
            self._clock.sleep_until(deadline)
            begun = self._clock.now()
            slot += 1 + self._count_missed(begun - deadline)
            self._tick(deadline, deadline - start, deadline - origin, begun)
        self._report_changes()

    def _count_missed(self, lateness: float) -> int:
        """Count and return the whole periods by which this tick is late."""
        missed = int(lateness / self._dt)
        self._missed_in_a_row = self._missed_in_a_row + missed if missed else 0
        self.timing.missed += missed
        self.timing.longest_row = max(self.timing.longest_row, self._missed_in_a_row)
        return missed

    def _tick(self, deadline: float, running: float, elapsed: float, begun: float) -> None:
        """Run one tick.

        Args:
            deadline: of the tick, s of the clock.
            running: the deadline from the loop's start, s.
            elapsed: the deadline from the log's origin, s.
            begun: when the tick began, s of the clock.
        """
        self.ticks += 1
        self.time, lateness = self.ticks * self._dt, begun - deadline
        tick, command = self._controller.tick(self.time, running, lateness, self._missed_in_a_row)
        self._send(deadline + LEAD, command)
        cost = self._clock.now() - begun
        self.timing.lateness.add(lateness)
        self.timing.cost.add(cost)
        self._report_changes()
        timing = self._tick_timing(elapsed, lateness, cost)
        for output in self._outputs:
            output.tick(tick, timing)

    def _send(self, valid_from: float, command: Command) -> None:
        state = self._controller.state.number
        for drive in self._drives:
            drive.send(self.ticks, self.time, valid_from, state, command)

    def _tick_timing(self, elapsed: float, lateness: float, cost: float) -> TickTiming:
        age, state = self._controller.reading.age, self._controller.state.number
        age = age if isfinite(age) else -1.0  # there was no sample yet
        return TickTiming(self.time, elapsed, lateness, cost, age, self.timing.missed, state)

    def _report_changes(self) -> None:
        """Report the changes of state since the last tick, before the first tick of a new state."""
        for state, reason in self._controller.take_changes():
            for output in self._outputs:
                output.status(self.time, state.value, reason)
