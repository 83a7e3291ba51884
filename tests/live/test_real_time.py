"""What the drives do, by the reference receiver on a virtual clock: is it what the log says?

The vehicle rolls, the loop is late in every way, and the platform parks in the end.
"""

import copyreg
from copy import deepcopy
from random import Random

import pytest

from atlas_cueing.live.control.certified_axis import AxisLimits, CertifiedStop, SoftStop
from atlas_cueing.live.control.command import axes_of
from atlas_cueing.live.control.state_machine import State

from .rig import Rig
from .virtual_drives import Delays, VirtualDrives, errors, excess, fly, punctual


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


def slot_in(state: State) -> int:
    """A slot of the punctual ride in this state, moving; a hold begins ten slots before its own."""
    if state in (State.HOLDING, State.FAULT_STOPPING):
        return slot_in(State.RUNNING) + 12
    calm = punctual(100.0).tape.timings
    slots = [k for k, timing in enumerate(calm, 1) if timing.state == state.number]
    return slots[min(len(slots) // 2 + 60, len(slots) - 20)]


@pytest.mark.parametrize(
    "state",
    [State.ENGAGING, State.RUNNING, State.HOLDING, State.PARKING, State.FAULT_STOPPING],
)
@pytest.mark.parametrize(("stall", "inside"), [(0.009, False), (0.025, True), (0.3, False)])
def test_after_a_stall_both_fly_the_same_stop(state: State, stall: float, inside: bool) -> None:
    """Before a tick, or in the middle of it."""
    slot, delays = slot_in(state), dict[int, float]()
    delays[slot] = stall
    if state is State.FAULT_STOPPING:
        delays[slot - 4] = 0.025

    def hold(rig: Rig, now: int) -> None:
        if state is State.HOLDING and now == slot - 10:
            rig.press("hold")

    late: dict[str, object] = {"cost" if inside else "delays": lambda k: delays.get(k, 0.0)}
    rig, drives = fly(100.0, **{"delays": lambda _: 0.0, **late}, before_slot=hold)  # type: ignore[arg-type]
    assert rig.tape.timings[slot - 2].state == state.number
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


def test_a_sender_killed_at_any_slot_leaves_it_inside_its_travel(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Every seventh one of a ride; the drives come to rest by themselves, and keep every limit."""
    for never_changes in (AxisLimits, CertifiedStop, SoftStop):  # and cannot be copied if compiled
        monkeypatch.setitem(copyreg.dispatch_table, never_changes, lambda _: "the same one")
    rig = punctual(100.0)
    drives = VirtualDrives(looks=2)
    drives.start(rig)
    for k, (sequence, time, due, state) in enumerate(rig.tape.sent):
        rig.clock.time = 1e-9 * (due - 18_000_000)
        assert drives.send(sequence, time, due, state, rig.tape.commands[k])
        if k % 7 == 6:
            alone = deepcopy(drives, {id(rig): rig})
            alone.times, alone.path = alone.times[-3:], alone.path[-3:]
            alone.look(due + 1_000_000_000)
            assert excess(rig, alone) < 1e-5
            assert not any(v or a for _, v, a in axes_of(alone.path[-1]))


def test_a_run_ends_exactly_at_rest() -> None:
    last = punctual(250.0).tape.commands[-1]
    assert not any(v or a for _, v, a in axes_of(last))
