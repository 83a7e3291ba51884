"""The stop of a hold: inside the limits of any platform, no way back, half as hard as a fault's."""

from itertools import pairwise
from math import inf

import numpy as np
import pytest
from hypothesis import Phase, assume, example, given, settings
from hypothesis import strategies as st

from atlas_cueing.live.control.certified_axis import AxisLimits
from atlas_cueing.live.control.gentle_stop import GentleStop
from atlas_cueing.live.control.state_machine import State
from atlas_cueing.rotation import Vec3, geodesic

from ..rig import ROUNDING, Rig
from .guard_states import REST

DT = 1e-3
WEAK = ("platform.wheel_limits.acceleration_rad_s2=6", "platform.wheel_limits.jerk_rad_s3=20")
STIFF = ("platform.wheel_limits.acceleration_rad_s2=300", "platform.wheel_limits.jerk_rad_s3=2e4")
SLOW = ("platform.stage_limits.acceleration_m_s2=0.4", "platform.stage_limits.jerk_m_s3=0.5")
KEPT = ("platform.traction.keep=true",)
PRESETS = ["atlas-2.9m", "atlas-1.5m", "atlas-tabletop", "atlas-orthogonal"]

magnitudes = st.floats(-3.0, 3.0).map(lambda power: 10.0**power)
shares = st.integers(-1000, 1000).map(lambda k: k / 1000)
QUICK = [Phase.explicit, Phase.reuse, Phase.generate]  # shrinking takes minutes


def axis(speed: float, acceleration: float, jerk: float, travel: float = inf) -> AxisLimits:
    return AxisLimits("axis ", 1e-9, speed, acceleration, jerk, travel)


def flown(limits: AxisLimits, state: Vec3) -> tuple[np.ndarray, float]:
    """States of one axis of the stage until it stands, some 1000, and the time between them."""
    h = max(limits.stop(*state).duration, 1e-9) / 400
    stop = GentleStop([limits] * 6, [state if k == 3 else REST for k in range(6)], h)
    x = [state]
    while not stop.arrived:
        x.append(stop.next()[3])
        assert len(x) < 10_000
    return np.array(x), h


@settings(max_examples=60, phases=QUICK)
@given(magnitudes, magnitudes, magnitudes, magnitudes, shares, shares, shares)
@example(10.0, 10.0, 1.0, 1000.0, 0.0, 0.9, 0.424)  # near its speed, and still speeding up
@example(4.3, 0.11, 0.1, 0.2, 0.0, 0.0, 0.156)  # its end is not a whole number of steps away
def test_any_axis_from_any_state_that_can_stop(
    speed: float, acceleration: float, jerk: float, travel: float, p: float, v: float, a: float
) -> None:
    limits = axis(speed, acceleration, jerk, travel)
    state = p * travel, v * speed, a * min(acceleration, (speed * jerk) ** 0.5)
    certain = limits.stop(*state)
    u = state[1] + state[2] * abs(state[2]) / (2.0 * jerk)
    assume(max(abs(certain.end), abs(certain.turning_point)) <= travel and abs(u) <= speed)
    x, h = flown(limits, state)
    assert np.max(np.abs(x[:, 0])) <= travel * (1.0 + 1e-6)
    assert np.max(np.abs(x[:, 1])) <= speed * (1.0 + 1e-6)
    assert np.max(np.abs(x[:, 2])) <= acceleration * (1.0 + 1e-6)
    assert tuple(x[-1, 1:]) == (0.0, 0.0) or len(x) == 1
    assert np.all(np.abs(np.diff(x[:, 2])) / h <= jerk * (1.0 + 1e-5))
    line = x[:-1, 0] + 0.5 * h * (x[:-1, 1] + x[1:, 1])
    assert np.all(np.abs(x[1:, 0] - line) <= jerk * h**3 + acceleration * h**2 + 1e-9 * travel)


@settings(max_examples=60, phases=QUICK)
@given(magnitudes, magnitudes, magnitudes, shares, shares)
@example(10.0, 10.0, 1.0, 0.1, -0.095)  # with 0.4 of the jerk it would turn round, not with 0.5
def test_without_a_travel_it_is_at_most_half_as_hard_and_does_not_turn_round(
    speed: float, acceleration: float, jerk: float, v: float, a: float
) -> None:
    """Unless it would turn round with half of the jerk as well: then once."""
    limits = axis(speed, acceleration, jerk)
    state = 0.0, v * speed, a * acceleration
    assume(abs(state[1]) + state[2] ** 2 / (1.0 * jerk) <= speed)
    x, h = flown(limits, state)
    assert np.all(np.abs(np.diff(x[:, 2])) / h <= 0.5 * jerk * (1.0 + 1e-5))
    moving = x[np.abs(x[:, 1]) > 1e-9 * speed, 1]
    turns = sum(one * other < 0.0 for one, other in pairwise(moving))
    brakes_too_hard = state[1] * state[2] < 0.0 and state[2] ** 2 > abs(state[1]) * jerk
    assert turns <= brakes_too_hard


@settings(max_examples=30, phases=QUICK)
@given(st.tuples(shares, shares, shares), st.floats(-0.3, 1.0))
def test_wheels_stop_together_and_keep_the_axis_of_rotation(speeds: Vec3, push: float) -> None:
    """With accelerations along the speeds."""
    assume(max(map(abs, speeds)) > 1e-2)
    limits = axis(31.0, 60.0, 600.0)
    states = [(0.0, 15.0 * v, 20.0 * push * v) for v in speeds] + [REST] * 3
    stop = GentleStop([limits] * 6, states, 0.01)
    while not stop.arrived:
        w = np.array([state[1] for state in stop.next()[:3]])
        across = w - np.dot(w, speeds) / np.dot(speeds, speeds) * np.array(speeds)
        assert np.linalg.norm(across) <= 2e-3 * 15.0 * np.linalg.norm(speeds)


def held(platform: str, settings: tuple[str, ...]) -> Rig:
    """Held in a roll at 0.9 rad/s, at rest now."""
    rig = Rig(0.01, platform, ("cueing.method=attitude", *settings), rate=0.9)
    rig.bring_to(State.HOLDING)
    rig.until(lambda: not rig.platform.moving, 60.0)
    return rig


@pytest.mark.parametrize(
    "settings", [(), WEAK, STIFF, SLOW, KEPT], ids=["", "weak", "stiff", "slow", "kept"]
)
@pytest.mark.parametrize("platform", PRESETS)
def test_a_hold_ends_where_it_led_to(platform: str, settings: tuple[str, ...]) -> None:
    """The orientation nears its last one from the first tick on, on any platform, without a fault;
    and what comes after it, the way home, begins there."""
    rig = held(platform, settings)
    begun = next(k for k, timing in enumerate(rig.tape.timings) if timing.state == 3.0)
    left = [geodesic(tick.motion.q_WS, rig.motion.q_WS) for tick in rig.tape.ticks[begun - 1 :]]
    assert left[0] > 0.01
    assert all(later <= earlier + 1e-9 for earlier, later in pairwise(left))
    rig.press("park")
    rig.tick()
    rig.until(State.PARKED, 120.0)
    assert rig.controller.outcome.faults == 0
    assert rig.excess() <= ROUNDING


@pytest.mark.parametrize("platform", PRESETS)
def test_the_force_jerk_is_at_most_half_of_a_faults(platform: str) -> None:
    """That of the stage, which the rider feels whole; from the same state."""
    largest = {}
    for state in (State.HOLDING, State.FAULT_STOPPING):
        rig = Rig(0.01, platform, ("cueing.stage.planner=onset",), rate=0.9)
        rig.bring_to(State.RUNNING)
        rig.fly(0.37)
        begun = len(rig.tape.commands) - 1
        assert any(rig.tape.commands[-1].v_WS_W), "the stage moves"
        if state is State.HOLDING:
            rig.press("hold")
            rig.fly(3.0)
        else:
            rig.tick(lateness=0.025)
            rig.fly(1.0)
        a = np.array([command.a_WS_W for command in rig.tape.commands[begun:]])
        largest[state] = np.max(np.linalg.norm(np.diff(a, axis=0), axis=1)) / rig.dt
    assert 0.0 < largest[State.HOLDING] <= 0.5 * largest[State.FAULT_STOPPING]


@pytest.mark.parametrize("seed", range(6))
def test_random_platforms(seed: int) -> None:
    """Limits of four orders of magnitude: no fault, no limit passed, and one way only."""
    random = np.random.default_rng(seed)
    limits = {
        "wheel_limits.speed_rad_s": 10.0 ** random.uniform(0.5, 2.0),
        "wheel_limits.acceleration_rad_s2": 10.0 ** random.uniform(0.0, 3.0),
        "wheel_limits.jerk_rad_s3": 10.0 ** random.uniform(0.5, 4.0),
        "stage_limits.acceleration_m_s2": 10.0 ** random.uniform(-1.0, 1.0),
        "stage_limits.jerk_m_s3": 10.0 ** random.uniform(-0.5, 2.0),
    }
    rig = held("atlas-2.9m", tuple(f"platform.{key}={value:.4g}" for key, value in limits.items()))
    begun = next(k for k, timing in enumerate(rig.tape.timings) if timing.state == 3.0)
    speeds = np.array([command.wheel_speed for command in rig.tape.commands[begun:]])
    pushed = np.array(rig.tape.commands[begun - 1].wheel_acceleration)
    for k in range(3):
        moving = speeds[np.abs(speeds[:, k]) > 1e-9, k]
        turns = sum(one * other < 0.0 for one, other in pairwise(moving))
        assert turns <= (speeds[0, k] * pushed[k] < 0.0)
    assert rig.controller.outcome.faults == 0
    assert rig.excess() <= ROUNDING


def test_near_the_end_of_the_travel_it_plans_a_harder_stop_and_keeps_to_it() -> None:
    """Not a soft one that has to be given up on the way for one of the full jerk."""
    speed, jerk, travel = 0.3, 60.0, 0.5
    limits = axis(1.0, 6.0, jerk, travel)
    soft, _ = flown(limits, (0.0, speed, 0.0))
    room = 0.5 * (soft[-1, 0] + limits.stop(0.0, speed, 0.0).end)
    path, h = flown(limits, (travel - room, speed, 0.0))
    assert path[:, 0].max() <= travel
    assert 0.45 * jerk <= np.abs(np.diff(path[:, 2])).max() / h <= 0.95 * jerk


@pytest.mark.parametrize("beyond", [-9e-7, -6e-7, 0.0, 2e-7, 4e-7])
def test_it_ends_inside_the_travel_itself_where_smoothing_begins(beyond: float) -> None:
    """And not merely inside of what the guard's room for rounding adds to it."""
    speed, travel = 0.3, 0.5
    limits = axis(1.0, 6.0, 60.0, travel)
    soft, _ = flown(limits, (0.0, speed, 0.0))
    path, _ = flown(limits, (travel * (1.0 + beyond) - soft[-1, 0], speed, 0.0))
    assert path[-1, 0] <= travel * (1.0 - 4e-7)


@pytest.mark.parametrize("h", [1e-3, 2e-3, 4e-3])
@pytest.mark.parametrize("limits", [(31.0, 60.0, 600.0, inf), (0.5, 1.0, 50.0, 0.3)])
def test_where_traction_is_kept_the_guard_lets_it_pass_tick_by_tick(
    h: float, limits: tuple[float, float, float, float]
) -> None:
    """Its jerk is not the guard's own limit, which rounding would pass at every other tick."""
    speed, acceleration, _, _ = limits
    guarded = AxisLimits("axis ", h, *limits, stop_share=0.5)
    for v, a in ((0.1, 0.0), (0.3, 0.4), (-0.7, 0.2), (0.5, -0.8), (0.001, 0.003)):
        before = 0.0, v * speed, a * acceleration
        stop = GentleStop([guarded] * 6, [before] * 6, h)
        while not stop.arrived:
            now = stop.next()[0]
            assert not guarded.breach(h, *before, *now)
            before = now
