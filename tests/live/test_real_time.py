"""What the drives do, by the reference receiver on a virtual clock: is it what the log says?

The vehicle rolls, the loop is late in every way, and the platform parks in the end.
"""

from collections.abc import Callable
from functools import cache
from random import Random

import numpy as np
import pytest

from atlas_cueing.live.control.command import Command, axes_of
from atlas_cueing.live.control.state_machine import State
from atlas_cueing.live.output.receiver import SetPointReceiver
from atlas_cueing.live.output.setpoint import encode
from atlas_cueing.rotation import Quat, apply, exp, geodesic, multiply, subtract

from .rig import Array, Rig

Delays = Callable[[int], float]  # s that the wait for slot k takes too long
SENDER = ("127.0.0.1", 4001)
QUICK = ("cueing.method=attitude", "cueing.stage.planner=onset")


class VirtualDrives:
    """Drives that follow set points in real time; they are looked at `looks` times a slot.

    killed: the number of the last set point that comes.
    """

    def __init__(self, killed: int | None = None, looks: int = 5) -> None:
        self._killed, self._looks = killed, looks
        self.rig: Rig | None = None
        self.times: list[int] = []
        self.path: list[Command] = []
        self.tripped = 0
        self.refused = ""

    def start(self, rig: Rig) -> None:
        self.rig, self.receiver = rig, SetPointReceiver(rig.wheel_limits, rig.stage_limits)
        self._slot = round(1e9 * rig.dt)

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:
        now = round(1e9 * self.rig.clock.now())
        self.look(now)
        if self._killed is None or sequence <= self._killed:
            packet = encode(7, sequence, time, due, state, command)
            self.refused = self.refused or self.receiver.take(packet, SENDER, now)
        return True

    def look(self, until: int) -> None:
        """Go on to `until` (ns), at times that are whole shares of a slot."""
        step = self._slot // self._looks
        first = self.times[-1] + step if self.times else until - until % step
        for now in range(first, until + 1, step):
            command = self.receiver.at(now)
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
) -> tuple[Rig, VirtualDrives]:
    """A whole ride: engaged at once, over after `seconds`, parked."""
    drives = VirtualDrives(killed)
    rig = Rig(
        1.0 / rate,
        settings=QUICK,
        attended=False,
        duration=seconds,
        rate=0.9,
        lead=lead,
        drives=[drives],
    )
    drives.start(rig)
    rig.controller.engage()
    wait, tick = rig.clock.sleep_until, rig.controller.tick

    def sleep_until(time: float) -> None:
        rig.clock.delay = delays(rig.loop.ticks)
        wait(time)

    def costly(slot: object) -> object:
        step = rig.platform.step

        def slow(vehicle: object) -> object:
            rig.clock.time += cost(rig.loop.ticks)
            return step(vehicle)  # type: ignore[arg-type]

        rig.platform.step = slow  # type: ignore[assignment, method-assign]
        try:
            return tick(slot)  # type: ignore[arg-type]
        finally:
            del rig.platform.step  # type: ignore[method-assign]

    rig.clock.sleep_until = sleep_until  # type: ignore[method-assign]
    rig.controller.tick = costly  # type: ignore[assignment, method-assign]
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


def every(slots: int, late: float) -> Delays:
    return lambda k: late if k % slots == slots - 1 else 0.0


def at_random(seed: int, mean: float, most: float) -> Delays:
    random = Random(seed)
    return lambda _: min(random.expovariate(1.0 / mean), most)


PATTERNS: dict[str, tuple[float, Delays, float]] = {
    "100 Hz on time": (100.0, lambda _: 0.0, 0.008),
    "1 kHz, one in 50 late by 3.5 ms": (1000.0, every(50, 0.0035), 0.008),
    "1 kHz, random lateness of 0.4 ms": (1000.0, at_random(1, 4e-4, 0.005), 0.008),
    "500 Hz, one in 100 late by 9 ms": (500.0, every(100, 0.009), 0.012),
    "100 Hz, one in 20 late by 19 ms": (100.0, every(20, 0.019), 0.022),
    "500 Hz, random": (500.0, at_random(4, 4e-4, 0.0015), 0.008),
    "250 Hz, random": (250.0, at_random(2, 8e-4, 0.003), 0.008),
    "100 Hz, random": (100.0, at_random(3, 3e-3, 0.006), 0.008),
}


@pytest.mark.parametrize("pattern", PATTERNS)
def test_a_late_ride_is_the_punctual_one(pattern: str) -> None:
    rate, delays, lead = PATTERNS[pattern]
    rig, drives = fly(rate, delays, lead=lead, seconds=2.0 if rate > 400.0 else 6.0)
    assert (rig.controller.outcome.faults, drives.tripped, drives.refused) == (0, 0, "")
    if rate < 400.0:
        assert rig.tape.commands == punctual(rate).tape.commands
        assert rig.tape.ticks[-1].motion == punctual(rate).tape.ticks[-1].motion
    attitude, wheels, stage = errors(rig, drives)
    assert attitude < 0.05
    assert max(wheels, stage) < 1e-9
    assert excess(rig, drives) < 1e-5


@pytest.mark.parametrize("state", [State.ENGAGING, State.RUNNING, State.PARKING])
@pytest.mark.parametrize("stall", [0.009, 0.025, 0.3])
@pytest.mark.parametrize("inside", [False, True])
def test_after_a_stall_both_fly_the_same_stop(state: State, stall: float, inside: bool) -> None:
    """Before a tick, or in the middle of it."""
    calm = punctual(100.0).tape.timings
    slots = [k for k, timing in enumerate(calm, 1) if timing.state == state.number]
    slot = slots[min(len(slots) // 2 + 60, len(slots) - 10)]

    def late(k: int) -> float:
        return stall if k == slot else 0.0

    def on_time(_: int) -> float:
        return 0.0

    rig, drives = fly(100.0, on_time if inside else late, cost=late if inside else on_time)
    assert rig.controller.outcome.faults == 1
    assert drives.refused == ""
    attitude, wheels, stage = errors(rig, drives)
    assert attitude < 0.05
    assert max(wheels, stage) < 1e-6
    assert excess(rig, drives) < 1e-5
    assert rig.tape.statuses[-1][1] == "stopped"


def test_a_stall_while_it_stands_is_no_fault() -> None:
    rig, drives = fly(250.0, lambda k: 0.3 if k in (20, 120) else 0.0)
    assert (rig.controller.outcome.faults, drives.tripped, drives.refused) == (0, 0, "")
    assert max(errors(rig, drives)[1:]) < 1e-9


def test_a_sender_killed_at_any_slot_leaves_it_inside_its_travel() -> None:
    slots = len(punctual(100.0).tape.commands)
    for killed in range(130, slots, 211):
        rig, drives = fly(100.0, lambda _: 0.0, killed=killed)
        assert excess(rig, drives) < 1e-5
        assert not any(v or a for _, v, a in axes_of(drives.path[-1]))


def test_a_run_ends_exactly_at_rest() -> None:
    last = punctual(250.0).tape.commands[-1]
    assert not any(v or a for _, v, a in axes_of(last))
