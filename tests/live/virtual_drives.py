"""Drives on a virtual clock, by the reference receiver, and rides before them."""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from atlas_cueing.live.control.command import Command, axes_of
from atlas_cueing.live.control.drive_status import DriveStatus
from atlas_cueing.live.input.source import SourceReading
from atlas_cueing.live.output import hello, status
from atlas_cueing.live.output.hello import Hello, limits_hash
from atlas_cueing.live.output.receiver import SetPointReceiver
from atlas_cueing.live.output.setpoint import encode
from atlas_cueing.live.output.status_sender import StatusSender
from atlas_cueing.rotation import Quat, apply, exp, geodesic, multiply, subtract

from .rig import Array, Rig

Delays = Callable[[int], float]  # s that the wait for slot k takes too long
SENDER = ("127.0.0.1", 4001)
QUICK = ("cueing.method=attitude", "cueing.stage.planner=onset")


class VirtualDrives:
    """Drives that follow set points in real time; they are looked at `looks` times a slot.

    killed: the number of the last set point that comes.
    lost: numbers of set points that do not come.
    mute: from this time on (ns) they tell nothing.
    latched: from this time on (ns) they say that they have latched.
    """

    session = 7
    refusal = ""

    def __init__(self, killed: int | None = None, looks: int = 5) -> None:
        self._killed, self._looks = killed, looks
        self.lost: frozenset[int] = frozenset()
        self.mute = self.latched = 1 << 62
        self._said: deque[bytes] = deque()
        self._hellos = 0
        self.rig: Rig
        self.times: list[int] = []
        self.path: list[Command] = []
        self.tripped = 0
        self.refused = ""

    def start(self, rig: Rig) -> None:
        self.rig, self.receiver = rig, SetPointReceiver(rig.wheel_limits, rig.stage_limits)
        self._limits = limits_hash(rig.wheel_limits, rig.stage_limits)
        self._status = StatusSender(self.receiver, self._limits)
        self._slot = round(1e9 * rig.dt)

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:
        now = round(1e9 * self.rig.clock.now())
        self.look(now)
        if sequence % round(1.0 / self.rig.dt) == 1:
            self._hellos += 1
            asked = Hello(self.session, self._hellos, now, self._limits)
            assert self._status.hear(hello.encode(asked), SENDER, now) == ""
        if (self._killed is None or sequence <= self._killed) and sequence not in self.lost:
            packet = encode(7, sequence, time, due, state, command)
            self.refused = self.refused or self.receiver.take(packet, SENDER, now)
        return True

    def statuses(self) -> Sequence[DriveStatus]:
        """What they have said up to now."""
        self.look(round(1e9 * self.rig.clock.now()))
        told = [status.decode(packet) for packet in self._said]
        self._said.clear()
        assert all(session == self.session for session, _ in told)
        return [self._wrong(one) for _, one in told]

    def _wrong(self, one: DriveStatus) -> DriveStatus:
        if one.time < self.latched:
            return one
        return replace(one, state="latched", reason="by hand")

    def look(self, until: int) -> None:
        """Go on to `until` (ns), at times that are whole shares of a slot."""
        step = self._slot // self._looks
        first = self.times[-1] + step if self.times else until - until % step
        for now in range(first, until + 1, step):
            command = self.receiver.at(now)
            if now < self.mute:
                self._said += [packet for packet, _ in self._status.due(now)]
            if command is not None:
                self.times.append(now)
                self.path.append(command)
                self.tripped += self.receiver.tripped != ""


def fly(
    rate: float,
    delays: Delays,
    *,
    lead: float = 0.008,
    seconds: float = 6.0,
    killed: int | None = None,
    cost: Delays = lambda _: 0.0,
    drives: VirtualDrives | None = None,
    speak: bool = False,
    before_slot: Callable[[Rig, int], None] = lambda _rig, _slot: None,
) -> tuple[Rig, VirtualDrives]:
    """A whole ride: engaged at once, over after `seconds`, parked."""
    drives = drives or VirtualDrives(killed)
    rig = Rig(
        1.0 / rate,
        settings=QUICK,
        attended=False,
        duration=seconds,
        rate=0.9,
        lead=lead,
        drives=[drives],
        feedback=drives if speak else None,
    )
    drives.start(rig)
    rig.controller.engage()
    wait, read = rig.clock.sleep_until, rig.source.read

    def sleep_until(time: float) -> None:
        rig.clock.delay = delays(rig.loop.ticks)
        before_slot(rig, rig.loop.ticks)
        wait(time)

    def slow(time: float, advance: bool) -> SourceReading:
        rig.clock.time += cost(rig.loop.ticks)
        return read(time, advance)

    rig.clock.sleep_until = sleep_until  # type: ignore[method-assign]
    rig.source.read = slow  # type: ignore[method-assign]
    rig.loop.run()
    drives.look(rig.tape.sent[-1][2] + 600_000_000)
    return rig, drives


@cache
def punctual(rate: float) -> Rig:
    return fly(rate, lambda _: 0.0)[0]


def errors(rig: Rig, drives: VirtualDrives) -> tuple[float, float, float]:
    """Largest difference of attitude (deg), wheel angle (rad) and stage (m) at the due times."""
    due = {sent[2]: k for k, sent in enumerate(rig.tape.sent)}
    J = rig.scenario.platform.geometry().sphere_from_wheels
    q: Quat = (1.0, 0.0, 0.0, 0.0)
    before = (0.0, 0.0, 0.0)
    worst, seen = [0.0, 0.0, 0.0], 0
    for now, command in zip(drives.times, drives.path, strict=True):
        q = multiply(exp(apply(J, subtract(command.wheel_angle, before))), q)
        before = command.wheel_angle
        if now in due:
            seen += 1
            asked, tick = rig.tape.commands[due[now]], rig.tape.ticks[due[now]]
            gap = np.subtract(axes_of(command), axes_of(asked))[:, 0]
            worst[0] = max(worst[0], np.degrees(geodesic(q, tick.motion.q_WS)))
            worst[1] = max(worst[1], float(np.max(np.abs(gap[:3]))))
            worst[2] = max(worst[2], float(np.max(np.abs(gap[3:]))))
    assert seen >= len(rig.tape.sent) - 2, "each due time is looked at"
    return worst[0], worst[1], worst[2]


def excess(rig: Rig, drives: VirtualDrives) -> float:
    """Largest share of any limit used between the set points, less one.

    The acceleration may pass by J h / 2, as documented of the receiver.
    """
    x: Array = np.array([axes_of(command) for command in drives.path])
    wheels, stage, step = rig.wheel_limits, rig.stage_limits, np.diff(drives.times) * 1e-9
    speed, acceleration, jerk = (
        np.array((*getattr(wheels, name), *getattr(stage, name)))
        for name in ("speed", "acceleration", "jerk")
    )
    bend = 0.5 * jerk * rig.dt
    return (
        max(
            float(np.max(np.abs(x[:, 3:, 0]) / stage.travel)),
            float(np.max(np.abs(x[:, :, 1]) / (speed + 0.25 * bend * rig.dt))),
            float(np.max(np.abs(x[:, :, 2]) / (acceleration + bend))),
            float(np.max(np.abs(np.diff(x[:, :, 2], axis=0) / step[:, None]) / jerk)),
        )
        - 1.0
    )
