"""What a rig has around it: a clock, a vehicle, a tape, and an operator."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from math import cos, inf, sin

from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.controller import LiveController
from atlas_cueing.live.control.slot import Slot
from atlas_cueing.live.input.source import SourceReading
from atlas_cueing.rotation import (
    IDENTITY,
    Quat,
    Vec3,
    exp,
    integrate_body,
    multiply,
    normalise,
    scale,
)
from atlas_cueing.signals import Tick, Timing, VehicleState


class FakeClock:
    """Time goes on with each sleep, and by `delay` (s) more, if that is set, once."""

    def __init__(self, start: float = 100.0) -> None:
        self.time, self.delay = start, 0.0

    def now(self) -> float:
        return self.time

    def sleep_until(self, time: float) -> None:
        self.time = max(self.time, time) + self.delay
        self.delay = 0.0


class TumblingSource:
    """A vehicle that turns for ever about a changing axis, with every fault of an input on demand.

    quiet: nothing comes from now on.
    bad: number of samples that are refused from now on.
    jumps: the vehicle is at another attitude at the next read.
    raises: by every read.
    prepared: the times that it was told of ahead.
    """

    def __init__(self, dt: float, rate: float = 0.6) -> None:
        self._dt, self._rate = dt, rate
        self.q: Quat = IDENTITY
        self._t = self._newest = -inf
        self.quiet = self.jumps = self.over = False
        self.bad, self._row = 0, 0
        self.raises: BaseException | None = None
        self.pinned = self.released = self.closed = 0
        self.remark = ""
        self.vehicle: VehicleState | None = None
        self.advanced: list[bool] = []
        self.prepared: list[float] = []

    def read(self, time: float, advance: bool) -> SourceReading:
        if self.raises:
            raise self.raises
        assert time > self._t, "times strictly increase"
        self._t = time
        self.advanced.append(advance)
        w = self._w(time)
        self.q = normalise(integrate_body(self.q, scale(self._dt, w), w, w, self._dt))
        dropped, jumped = 0, self.jumps
        if self.jumps:
            self.q, self.jumps = multiply(self.q, exp((0.9, -2.0, 0.4))), False
        if self.bad:
            self.bad, self._row, dropped = self.bad - 1, self._row + 1, 1
        elif not self.quiet:
            self._row, self._newest = 0, time
            self.vehicle = VehicleState(
                time, self.q, w, (1.5 * sin(time), cos(1.3 * time), -9.8 + sin(2.0 * time))
            )
        vehicle = self.vehicle and replace(self.vehicle, time=time)
        reason = "NaN" if dropped else "reset" if jumped else ""
        return SourceReading(
            *(vehicle, time - self._newest, dropped, self._row, jumped, self.over, reason),
            remark=self.remark,
        )

    def prepare(self, time: float) -> None:
        self.prepared.append(time)

    def pin(self) -> None:
        self.pinned += 1

    def release(self) -> None:
        self.released += 1

    def close(self) -> None:
        self.closed += 1

    def _w(self, t: float) -> Vec3:
        return (self._rate, 0.5 * self._rate * sin(0.7 * t), 0.4 * self._rate * cos(0.9 * t))


@dataclass
class Tape:
    """An output and a drive that keep everything, in the order in which it came."""

    ticks: list[Tick] = field(default_factory=list)
    timings: list[Timing] = field(default_factory=list)
    statuses: list[tuple[float, str, str]] = field(default_factory=list)
    commands: list[Command] = field(default_factory=list)
    sent: list[tuple[int, float, int, int]] = field(default_factory=list)
    order: list[str] = field(default_factory=list)

    def tick(self, tick: Tick, timing: Timing) -> None:
        self.ticks.append(tick)
        self.timings.append(timing)
        self.order.append("tick")

    def status(self, time: float, state: str, reason: str) -> None:
        self.statuses.append((time, state, reason))
        self.order.append(state)

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:
        self.commands.append(command)
        self.sent.append((sequence, time, due, state))
        return True


class Watched:
    """A controller in the loop's hands, and what is done before each tick and ahead of the next."""

    def __init__(
        self,
        controller: LiveController,
        before: Callable[[], None] = lambda: None,
        ahead: Callable[[float], None] = lambda _: None,
    ) -> None:
        self._controller, self._before, self._ahead = controller, before, ahead

    def tick(self, slot: Slot) -> tuple[Tick, Command]:
        self._before()
        return self._controller.tick(slot)

    def prepare(self, time: float) -> None:
        self._ahead(time)
        self._controller.prepare(time)

    def __getattr__(self, name: str) -> object:
        return getattr(self._controller, name)


@dataclass
class Wanted:
    """Buttons and signals to come."""

    buttons: list[str] = field(default_factory=list)
    signals: int = 0

    def edges(self) -> Sequence[str]:
        pressed, self.buttons = self.buttons, []
        return pressed
