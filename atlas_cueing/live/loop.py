"""The real-time loop: one tick a slot, one slot a period of the clock.

Slot k = 1, 2, ... has the deadline start + k dt, the platform's time k dt, and a set point due at

    d_k = start + (k + 1) dt + lead

since whoever follows set points needs number k when number k - 1 is due. A slot that begins late is
run all the same and those behind it in order, without a sleep: a late ride is the punctual one, bit
for bit. A slot is lost when its set point would come after d_k-1; what follows is up to the
controller. Deadlines and due times are whole nanoseconds from the start: no rounding adds up.
"""

# mypyc: runs every tick

from collections.abc import Sequence
from math import isfinite
from typing import Protocol

from ..signals import Tick
from ..signals import Timing as TickTiming
from .clock import Clock
from .control.command import Command
from .control.slot import Slot
from .control.state_machine import State
from .input.source import SourceReading
from .timing import LoopTiming

LEAD = 0.008  # s, by default: what lateness and transport of a set point may use up


class Output(Protocol):
    """Keeps or shows ticks without ever making the loop wait."""

    def tick(self, tick: Tick, timing: TickTiming) -> None:
        """Take one tick."""

    def status(self, time: float, state: str, reason: str) -> None:
        """Take a change of state at `time` (s)."""


class Controller(Protocol):
    """Makes the ticks (`control.controller.LiveController`)."""

    @property
    def state(self) -> State:
        """The state the platform is in."""

    @property
    def over(self) -> bool:
        """Whether the run is over."""

    @property
    def reading(self) -> SourceReading:
        """What the source said last."""

    def take_changes(self) -> list[tuple[State, str]]:
        """Return the changes of state since the last call, each with its reason."""

    def tick(self, slot: Slot) -> tuple[Tick, Command]:
        """Make the tick of this slot, and the command to the drives."""

    def prepare(self, time: float) -> None:
        """Do what can be done ahead of the tick at `time` (s)."""


class Drives(Protocol):
    """Takes commands to the drives without ever making the loop wait."""

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:
        """Take one set point; return whether it went out.

        Args:
            sequence: number of the tick, from 1.
            time: of the platform, s.
            due: when the drives shall have that motion, ns of the loop's clock.
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
        controller: Controller,
        outputs: Sequence[Output],
        drives: Sequence[Drives],
        origin: float | None = None,
        lead: float = LEAD,
    ) -> None:
        """Set up; nothing runs yet.

        Args:
            dt: tick, s, in whole nanoseconds.
            clock: of the deadlines.
            controller: makes the ticks.
            outputs: take every tick and every change of state.
            drives: take every command.
            origin: s of the clock that the log counts its real time from; the loop's start by
                default.
            lead: from the end of a slot to the time its set point is due, s.
        """
        self._dt, self._dt_ns, self._lead_ns = dt, round(1e9 * dt), round(1e9 * lead)
        self._clock = clock
        self._controller = controller
        self._outputs = outputs
        self._drives = drives
        self._origin = origin
        self._missed_in_a_row = 0
        self._last_sent: Command | None = None
        self.ticks, self.time = 0, 0.0
        self.timing = LoopTiming()

    def run(self) -> None:
        """Tick until the controller's run is over."""
        start = round(1e9 * self._clock.now())
        origin = 1e-9 * (start + self._dt_ns) if self._origin is None else self._origin
        while not self._controller.over:
            self.ticks += 1
            deadline_ns = start + self.ticks * self._dt_ns
            deadline = 1e-9 * deadline_ns
            self._clock.sleep_until(deadline)
            begun = self._clock.now()
            self._count_missed(begun - deadline)
            self._tick(
                deadline_ns + self._dt_ns + self._lead_ns, deadline - origin, begun - deadline
            )
        self._report_changes()

    def _count_missed(self, lateness: float) -> None:
        """Count a slot that begins when the next one should."""
        missed = lateness >= self._dt
        self._missed_in_a_row = self._missed_in_a_row + 1 if missed else 0
        self.timing.missed += missed
        self.timing.longest_row = max(self.timing.longest_row, self._missed_in_a_row)

    def _tick(self, due: int, elapsed: float, lateness: float) -> None:
        """Run one tick.

        Args:
            due: time of its set point, ns of the clock.
            elapsed: its deadline from the log's origin, s.
            lateness: from its deadline to its beginning, s.
        """
        begun, self.time = self._clock.now(), self.ticks * self._dt
        slot = Slot(self._clock.now, self.time, 1e-9 * (due - self._dt_ns), due)
        tick, command = self._controller.tick(slot)
        self._send(due, command)
        cost = self._clock.now() - begun
        self.timing.lateness.add(lateness)
        self.timing.cost.add(cost)
        self._report_changes()
        timing = self._tick_timing(elapsed, lateness, cost)
        for output in self._outputs:
            output.tick(tick, timing)
        self._controller.prepare((self.ticks + 1) * self._dt)

    def _send(self, due: int, command: Command) -> None:
        """Send the set point of this slot; measure how far off the last one that went out is."""
        state = self._controller.state.number
        sent = [drive.send(self.ticks, self.time, due, state, command) for drive in self._drives]
        if all(sent) or self._last_sent is None:
            self._last_sent = command
        else:
            self.timing.add_difference(command, self._last_sent)

    def _tick_timing(self, elapsed: float, lateness: float, cost: float) -> TickTiming:
        age, state = self._controller.reading.age, self._controller.state.number
        age = age if isfinite(age) else -1.0  # there was no sample yet
        timing = self.timing
        behind = timing.wheel_difference, timing.stage_difference
        return TickTiming(self.time, elapsed, lateness, cost, age, timing.missed, state, *behind)

    def _report_changes(self) -> None:
        """Report the changes of state since the last tick, before the first tick of a new state."""
        for state, reason in self._controller.take_changes():
            for output in self._outputs:
                output.status(self.time, state.value, reason)
