"""Every fault in every state: no limit broken, an end at rest, and a run that can go on."""

from itertools import permutations
from random import Random

import pytest

from atlas_cueing.live.control.pose import AT_PARK
from atlas_cueing.live.control.state_machine import State
from atlas_cueing.rotation import IDENTITY, geodesic

from .faults import FAULTS, LEADS_ON, MATRIX, jump
from .rig import ROUNDING, Rig

QUICK = ("cueing.stage.planner=onset",)  # the stage's other planner, which costs less
LONGEST_END = 10.0  # s from the wish to stop or park to the end


@pytest.mark.parametrize("state", State)
def test_every_fault_in_every_state(state: State) -> None:
    """One after the other on one platform: each proves that it runs again after the last one."""
    rig = Rig(0.02, settings=QUICK)
    for name, (fault, leaves, to) in MATRIX.items():
        rig.bring_to(state)
        faults = rig.controller.outcome.faults
        fault(rig)
        expected = {to} if state in leaves else {state} | LEADS_ON.get(state, set())
        assert rig.state in expected, (name, rig.tape.statuses[-3:])
        assert rig.controller.outcome.faults == faults + (state in leaves and to in FAULTS), name
        home(rig)
    engage(rig)
    assert rig.excess() <= ROUNDING


def home(rig: Rig) -> None:
    """By the operator's hand from any state to rest at home; slowly after a fault."""
    if rig.state in FAULTS:
        rig.until(State.STOPPED, LONGEST_END)
        at_rest(rig)
        rig.source.raises = None
        rig.press("reset")
    elif rig.state is not State.PARKED:
        rig.press("park")
    rig.tick()
    rig.until(State.PARKED, 2.0 * LONGEST_END)
    at_rest(rig)
    assert geodesic(rig.motion.q_WS, IDENTITY) < AT_PARK + ROUNDING


def engage(rig: Rig) -> None:
    """From home to a run that follows the cue."""
    rig.press("engage")
    rig.tick()
    rig.until(State.RUNNING, 8.0)
    rig.fly(0.3)
    on_the_cue(rig)


def at_rest(rig: Rig) -> None:
    m = rig.motion
    assert max(map(abs, (*m.w_WS_W, *m.v_WS_W))) < 1e-3
    assert max(map(abs, (*m.alpha_WS_W, *m.a_WS_W))) < 1e-2


def on_the_cue(rig: Rig) -> None:
    assert geodesic(rig.motion.q_WS, rig.tape.ticks[-1].cue.q_WS) < 0.02


@pytest.mark.parametrize("state", [State.ENGAGING, State.RUNNING])
@pytest.mark.parametrize("name", ["quiet 150 ms", "three bad samples", "jump"])
def test_a_hold_by_the_input_ends_by_itself(name: str, state: State) -> None:
    """At rest after the halt; half a second of good input; then a second or more to the cue."""
    rig = Rig(settings=QUICK)
    rig.bring_to(state)
    held = rig.motion.q_WS
    MATRIX[name][0](rig)
    assert rig.state is State.HOLDING
    halt = rig.until(State.ENGAGING, 3.0)
    assert halt >= 0.4
    assert geodesic(rig.motion.q_WS, held) < 0.6  # as far as half of 0.8 s at its rate
    blend = rig.until(State.RUNNING, 6.0)
    assert 0.9 <= blend <= 5.0
    on_the_cue(rig)
    assert rig.excess() <= ROUNDING


def test_a_jump_is_frozen_not_chased() -> None:
    """From the jump to the end of the hold the rates only fall, though the vehicle is far away."""
    rig = Rig(settings=QUICK)
    rig.bring_to(State.RUNNING)
    before = max(map(abs, rig.motion.w_WS_W))
    jump(rig)
    begin = len(rig.tape.ticks)
    rig.until(State.ENGAGING, 3.0)
    rates = [max(map(abs, tick.motion.w_WS_W)) for tick in rig.tape.ticks[begin:]]
    assert max(rates) < 1.1 * before


@pytest.mark.parametrize("state", State)
def test_buttons_in_any_order(state: State) -> None:
    """All in one tick, then one after the other, 0.1 s apart: no order of them is a fault."""
    rig = Rig(0.02, settings=QUICK)
    orders = list(permutations(["engage", "hold", "park", "reset"]))
    for buttons in orders[state.number :: 8]:
        rig.bring_to(state)
        rig.press(*buttons)
        rig.tick()
        for name in buttons:
            rig.press(name)
            rig.fly(0.1)
        home(rig)
    assert rig.controller.outcome.faults == (
        len(orders[state.number :: 8]) if state in FAULTS else 0
    )
    engage(rig)
    assert rig.excess() <= ROUNDING


@pytest.mark.parametrize("state", State)
def test_one_signal_parks(state: State) -> None:
    rig = Rig(0.02, settings=QUICK, attended=False)
    rig.bring_to(state)
    rig.wanted.signals = 1
    rig.tick()
    took = rig.until(lambda: rig.controller.over, LONGEST_END - 1.0)
    at_rest(rig)
    assert rig.state is (State.STOPPED if state in FAULTS else State.PARKED)
    expected = {State.WAITING: "input_lost"} | dict.fromkeys(FAULTS, "fault")
    assert rig.controller.outcome.result == expected.get(state, "ok")
    assert rig.excess() <= ROUNDING
    assert took <= LONGEST_END


@pytest.mark.parametrize("state", State)
def test_two_signals_stop_at_once(state: State) -> None:
    rig = Rig(0.02, settings=QUICK, attended=False)
    rig.bring_to(state)
    rig.wanted.signals = 1
    rig.tick()
    rig.wanted.signals = 2
    if not rig.controller.over:
        rig.tick()
        assert rig.state in FAULTS
    assert rig.until(lambda: rig.controller.over, 2.0) < 1.0
    at_rest(rig)
    expected = {State.PARKED: "ok", State.FAULT_STOPPING: "fault", State.STOPPED: "fault"}
    expected[State.WAITING] = "input_lost"
    assert rig.controller.outcome.result == expected.get(state, "stopped")
    assert rig.excess() <= ROUNDING


def test_parking_from_upside_down_ends_in_time() -> None:
    """The longest way home there is, with a log to finish behind it."""
    rig = Rig(0.02, rate=0.9, settings=("cueing.method=attitude", *QUICK))
    rig.bring_to(State.RUNNING)
    rig.until(lambda: geodesic(rig.motion.q_WS, IDENTITY) > 3.0, 60.0)
    rig.wanted.signals = 1
    assert rig.until(lambda: rig.controller.over, LONGEST_END) < LONGEST_END - 0.5


@pytest.mark.parametrize("rate_hz", [100.0, 500.0, 1000.0])
@pytest.mark.parametrize("platform", ["atlas-2.9m", "atlas-tabletop", "atlas-orthogonal"])
def test_a_walk_among_faults(platform: str, rate_hz: float) -> None:
    """A longer one: the same with more ticks and other seeds."""
    rig = walk(platform, rate_hz, 2000, seed=round(rate_hz))
    assert len({timing.state for timing in rig.tape.timings}) >= 2
    assert rig.excess() <= ROUNDING


def walk(platform: str, rate_hz: float, ticks: int, seed: int) -> Rig:
    """Faults, buttons and good spells at random."""
    random, rig = Random(seed), Rig(1.0 / rate_hz, platform, rate=0.3)
    faults = [fault for fault, _, _ in MATRIX.values()]
    while len(rig.tape.commands) < ticks:
        rig.source.raises = None
        kind = random.random()
        if kind < 0.15:
            random.choice(faults)(rig)
        elif kind < 0.6:
            rig.press(random.choice(["engage", "reset", "engage", "reset", "hold", "park"]))
        rig.fly(random.choice([rig.dt, 0.05, 0.5, 1.2]))
    return rig
