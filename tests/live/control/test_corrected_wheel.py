"""Schedule and correction of a wheel together, under schedules and corrections of every kind."""

from collections.abc import Iterator
from random import Random

import numpy as np
import pytest

from atlas_cueing.live.control.certified_axis import AxisLimits
from atlas_cueing.live.control.corrected_wheel import CorrectedWheel

SPEED, ACCELERATION, JERK = 31.0, 60.0, 600.0
State = tuple[float, float, float]


def wild(dt: float, seed: int) -> Iterator[State]:
    """A schedule at its limits, with a jerk that changes three times a tick."""
    for k, state in enumerate(steady(dt / 3.0, seed)):
        if k % 3 == 2:
            yield state


def steady(dt: float, seed: int) -> Iterator[State]:
    """A motion at its limits: a jerk of full size, at random, as far as the rest allows."""
    random, (p, v, a) = Random(seed), (0.0, 0.0, 0.0)
    while True:
        for _ in range(random.choice((1, 1, 2, 40))):
            j = random.choice((-JERK, 0.0, JERK, JERK, -JERK))
            new = min(max(a + j * dt, -ACCELERATION), ACCELERATION)
            v1 = v + 0.5 * dt * (a + new)
            if abs(v1 + 0.5 * new * abs(new) / JERK) > SPEED:
                new = min(max(0.0, a - JERK * dt), a + JERK * dt)
                v1 = v + 0.5 * dt * (a + new)
            p, v, a = p + dt * v + dt * dt * (2.0 * a + new) / 6.0, v1, new
            yield p, v, a


def flown(dt: float, seed: int, ticks: int, rests: bool = True) -> np.ndarray:
    """The sum, as its states, over a wild schedule with wild corrections."""
    share = (0.1, 1.0)[seed // 10 % 2]
    wheel = CorrectedWheel(AxisLimits("wheel", dt, SPEED, ACCELERATION, JERK), dt, 0.0, share)
    random, before, kept = Random(seed + 1), (0.0, 0.0, 0.0), [(0.0, 0.0, 0.0)]
    stopping, schedule = 0, wild(dt, seed)
    wanted = 0.0
    for _ in range(ticks):
        after = next(schedule)
        wanted = random.choice((wanted, wanted, random.uniform(-40.0, 40.0), 0.0))
        if rests and not stopping and random.random() < 0.01:
            stopping = random.randrange(1, 60)
        if stopping:
            stopping -= 1
            wheel.stop()
        else:
            assert wheel.follow(before, after, wanted) == ""
        before = after
        kept.append(wheel.state)
    return np.array(kept)


@pytest.mark.parametrize("rate", [100.0, 250.0, 1000.0])
@pytest.mark.parametrize("seed", range(4))
def test_the_sum_keeps_every_limit(rate: float, seed: int) -> None:
    h = 1.0 / rate
    p, v, a = flown(h, 10 * seed, 20_000).T
    room = 1.0 + 2e-6
    assert np.abs(v).max() <= SPEED * room
    assert np.abs(a).max() <= ACCELERATION * room
    assert np.abs(np.diff(a)).max() <= JERK * h * room
    # there is a motion of limited jerk between any two: that of constant jerk, or the stop
    assert np.abs(v + 0.5 * a * np.abs(a) / JERK).max() <= SPEED * room, "so a stop is left"
    assert np.abs(np.diff(v) - 0.5 * h * (a[1:] + a[:-1])).max() <= 0.25 * JERK * h * h * room
    assert np.abs(np.diff(p) - h * v[:-1]).max() <= 0.5 * ACCELERATION * h * h * room


def test_a_correction_is_reached_beside_a_schedule_and_fades_with_it() -> None:
    h, schedule = 0.01, (0.0, 3.0, 0.0)
    wheel = CorrectedWheel(AxisLimits("wheel", h, SPEED, ACCELERATION, JERK), h, 0.0)
    wheel.state = schedule
    for wanted in (0.7, -0.4, 0.0):
        for _ in range(200):
            wheel.follow(schedule, schedule, wanted)
        assert wheel.state[1:] == pytest.approx((3.0 + wanted, 0.0), abs=1e-6)


def test_nothing_wanted_is_the_schedule() -> None:
    h = 0.01
    wheel = CorrectedWheel(AxisLimits("wheel", h, SPEED, ACCELERATION, JERK), h, 0.0)
    before = (0.0, 0.0, 0.0)
    for (p, v, a), _ in zip(wild(h, 3), range(3000), strict=False):
        after = (0.95 * p, 0.95 * v, 0.95 * a)  # at the very limit there is no room in whole ticks
        wheel.follow(before, after, 0.0)
        assert wheel.state == pytest.approx(after, abs=1e-9)
        before = after


def test_it_comes_to_rest_exactly() -> None:
    h = 0.01
    wheel = CorrectedWheel(AxisLimits("wheel", h, SPEED, ACCELERATION, JERK), h, 0.0)
    for _ in range(50):
        wheel.follow((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 2.0)
    assert not wheel.standing
    for _ in range(60):
        wheel.stop()
    assert wheel.standing
    assert wheel.state[1:] == (0.0, 0.0)


@pytest.mark.parametrize("h", [0.001, 0.002, 0.01])
def test_a_wheel_that_passes_its_zero_is_not_stopped(h: float) -> None:
    """There a position is rounded more coarsely than the one before it."""
    random = Random(5)
    for _ in range(300):
        wheel = CorrectedWheel(AxisLimits("wheel", h, SPEED, ACCELERATION, JERK), h, 0.0)
        speed = random.uniform(-20.0, 20.0)
        p, v, a = random.uniform(-2.0, 2.0) * h * speed, speed, ACCELERATION
        wheel.state = (p, v, a)
        before = (p, v - 1.0, a)
        for _ in range(6):
            after = (before[0] + h * before[1] + 0.5 * h * h * a, before[1] + h * a, a)
            assert wheel.follow(before, after, random.uniform(-9.0, 9.0)) == ""
            before = after
