"""The log of a run while it is flown."""

# mypyc: runs every tick

from collections.abc import Callable
from math import degrees, radians
from typing import Final, TypeAlias

from ..signals import Sink, Tick, VehicleState, attitude_jump

Progress: TypeAlias = Callable[[float], None]  # called now and then with the flight time, s

# Attitude and body rates of one step agree to dt^2/2 times the angular acceleration: 0.04 deg at
# 120 Hz and 20 rad/s^2. From here on (assumed) a difference is noted in /status as a jump; at 10 Hz
# a hard manoeuvre may pass for one.
JUMP: Final = radians(0.5)


class RunLog:
    """The log of a run, with its jumps of attitude noted.

    ticks: number of ticks recorded. time: of the last one, s.
    """

    def __init__(self, sink: Sink, progress: Progress) -> None:
        """Begin the log in `sink`; progress is called after every block."""
        self.ticks, self.time = 0, 0.0
        self._sink = sink
        self._progress = progress
        self._before: VehicleState | None = None
        self._jumping = False

    def add(self, block: list[Tick]) -> None:
        """Record a block of ticks."""
        for tick in block:
            self._sink.append(tick)
            self.ticks += 1
            self.time = tick.vehicle.time
            self._note_jump(tick.vehicle)
        self._progress(self.time)

    def status(self, state: str, reason: str) -> None:
        """Record a change of state at the last tick."""
        self._sink.status(self.time, state, reason)

    def finish(self, result: str, reason: str) -> None:
        """Finish the log with the result of the run, and why it is not ok."""
        self.status("done" if result == "ok" else result, reason)
        self._sink.close(result, reason)

    def _note_jump(self, now: VehicleState) -> None:
        jump = attitude_jump(self._before, now) if self._before else 0.0
        self._before = now
        if (jump >= JUMP) != self._jumping:
            self._jumping = not self._jumping
            reason = (
                f"attitude jumped by {degrees(jump):.3g} deg that the body rates do not explain"
            )
            state = ("attitude_jump", reason) if self._jumping else ("running", "")
            self.status(*state)
