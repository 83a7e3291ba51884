"""The guard's stop against pinned distances, a simulation, smoothing's stop and every limit."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.live.control.certified_axis import CertifiedStop as _Stop
from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.guard import Guard
from atlas_cueing.smoothing import Stop

from .guard_states import (
    AXES,
    ROUNDING,
    STAGE,
    STANDING,
    WHEELS,
    State,
    alone,
    coast,
    command,
    excess,
    guard_at,
    limits,
    rows,
    states,
)

ROWS = json.loads((Path(__file__).parents[2] / "oracles" / "stop_distance.json").read_text())[
    "rows"
]
ROUGH = 3e-6  # share of a limit: the guard's room, and the rounding of third differences over 1 ms

speeds = st.floats(-50.0, 50.0) | st.floats(-1e-6, 1e-6)
shares = st.floats(-1.0, 1.0) | st.sampled_from([-1.0, 0.0, 1.0])
bounds = st.floats(0.5, 100.0)
jerks = st.floats(1.0, 1000.0)
places = st.floats(-5.0, 5.0)


@pytest.mark.parametrize("row", ROWS)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_pinned_distances(row: dict[str, float], sign: float) -> None:
    stop = _Stop(
        3.0,
        sign * row["v_m_s"],
        sign * row["a_m_s2"],
        row["max_acceleration_m_s2"],
        row["max_jerk_m_s3"],
    )
    assert sign * (stop.end - 3.0) == pytest.approx(row["stop_distance_m"], rel=1e-12)


@given(places, speeds, shares, bounds, jerks, st.floats(0.0, 1.2))
def test_it_is_the_shortest_stop(
    p: float, v: float, share: float, a_max: float, j_max: float, when: float
) -> None:
    """As smoothing's, which is told from its beginning and compared with ruckig and brute force."""
    mine, other = (
        _Stop(p, v, share * a_max, a_max, j_max),
        Stop.plan(v, share * a_max, a_max, j_max),
    )
    t = when * other.duration
    x, u, a = mine.at(t)
    scale = 1.0 + abs(v) + a_max
    assert (x - p, u, a) == pytest.approx(other.at(t), rel=1e-7, abs=2e-6 * scale)
    low, high = other.span()
    reached = (p, mine.end, mine.turning_point)
    assert (min(reached), max(reached)) == pytest.approx(
        (p + low, p + high), rel=1e-7, abs=1e-7 * scale
    )


@given(places, speeds, shares, bounds, jerks)
def test_it_is_one_motion_within_its_bounds(
    p: float, v: float, share: float, a_max: float, j_max: float
) -> None:
    """The jerk keeps its bound; speed and position are its integrals.

    It starts at the given state and ends at rest to the last bit.
    """
    stop = _Stop(p, v, share * a_max, a_max, j_max)
    span = 2.0 * (abs(v) / a_max + 2.0 * a_max / j_max)
    t = np.linspace(0.0, span, 501)
    h = t[1]
    x, u, a = np.array([stop.at(float(each)) for each in t]).T
    scale = abs(v) + a_max**2 / j_max
    assert x[0] == pytest.approx(p, abs=1e-13 * (1.0 + scale * span))
    assert (u[0], a[0]) == pytest.approx((v, share * a_max), abs=1e-12 * (scale + a_max))
    assert np.max(np.abs(a)) <= a_max * (1.0 + 1e-12)
    assert np.max(np.abs(np.diff(a))) <= j_max * h * (1.0 + 1e-9) + 1e-12 * a_max
    assert (
        np.max(np.abs(np.diff(u) - 0.5 * h * (a[1:] + a[:-1])))
        <= 0.25 * j_max * h * h * (1.0 + 1e-9) + 1e-12 * scale
    )
    error = np.diff(x) - 0.5 * h * (u[1:] + u[:-1]) + h * h / 12.0 * np.diff(a)
    assert np.max(np.abs(error)) <= 0.04 * j_max * h**3 + 1e-12 * (1.0 + scale * span)
    assert stop.at(span) == (stop.end, 0.0, 0.0)
    assert stop.at(1e6) == (stop.end, 0.0, 0.0)


@given(places, speeds, shares, bounds, jerks)
def test_it_is_in_its_last_ramp_until_the_end(
    p: float, v: float, share: float, a_max: float, j_max: float
) -> None:
    """It moves up to the end: no sooner at rest than any of the three ramps and holds allow."""
    stop = _Stop(p, v, share * a_max, a_max, j_max)
    t = np.linspace(0.0, Stop.plan(v, share * a_max, a_max, j_max).duration, 50)[:-1]
    assert all(stop.at(float(each))[1:] != (0.0, 0.0) for each in t) or abs(v) + abs(share) < 1e-3


def test_a_stop_of_nothing_is_nothing() -> None:
    for zero in (0.0, -0.0):
        stop = _Stop(0.5, zero, zero, 6.0, 60.0)
        assert stop.at(0.0) == stop.at(1.0) == (0.5, 0.0, 0.0)
        assert stop.turning_point == stop.end == 0.5


def ride(
    dt: float, plan: list[tuple[int, list[float]]], most: int = 4000
) -> tuple[Guard, list[Command], int]:
    """Jerks as shares of each axis' own for some ticks each, until a tick is refused.

    Then the stop, and a little longer.
    """
    guard, outputs, asked = Guard(dt, WHEELS, STAGE), [STANDING], list[State](states(STANDING))
    guard.start(STANDING)
    for ticks, share in plan:
        for _ in range(ticks):
            asked = [
                coast(state, s * limits(k)[2], dt)
                for k, (state, s) in enumerate(zip(asked, share, strict=True))
            ]
            outputs.append(guard.check(command(outputs[-1].time + dt, asked)))
            if guard.stopping:
                break
    passed = len(outputs)
    while not guard.standing and len(outputs) < passed + most:
        outputs.append(guard.stop(outputs[-1].time + dt))
    outputs += [guard.stop(outputs[-1].time + dt) for _ in range(5)]
    return guard, outputs, passed


rides = st.lists(
    st.tuples(st.integers(1, 60), st.lists(shares, min_size=6, max_size=6)), min_size=1, max_size=12
)


@settings(max_examples=40)
@given(st.sampled_from([1.0 / 1000.0, 1.0 / 120.0, 1.0 / 30.0]), rides)
def test_from_any_state_that_can_be_reached_it_keeps_every_limit_and_stands_still(
    dt: float, plan: list[tuple[int, list[float]]]
) -> None:
    guard, outputs, _ = ride(dt, plan)
    assert guard.stopping
    assert guard.standing
    assert excess(dt, outputs) <= ROUGH
    still = rows(outputs[-6:])
    assert np.all(still == still[0])
    assert np.all(still[:, :, 1:] == 0.0)


@pytest.mark.parametrize("axis", [3, 4, 5])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_driven_at_the_rail_it_stops_just_before_it(axis: int, sign: float) -> None:
    """Full speed outwards: refused when the stop would not fit any more, and not a tick sooner."""
    dt = 1e-3
    v, a, j, travel = limits(axis)
    n = int(0.9 * a / j / dt)
    hold = int(0.8 * v / (n * dt * j) / dt) - n
    course = ((n, sign), (hold, 0.0), (n, -sign), (4000, 0.0))
    guard, outputs, passed = ride(
        dt, [(ticks, [share if k == axis else 0.0 for k in range(6)]) for ticks, share in course]
    )
    assert guard.reason.startswith(f"{AXES[axis]} standstill ")
    assert passed > n + hold + n
    end = sign * rows(outputs)[-1, axis, 0]
    assert travel - 2.0 * v * dt < end <= travel * ROUNDING
    assert excess(dt, outputs) <= ROUGH


@pytest.mark.parametrize("axis", range(6))
def test_each_axis_stops_on_its_own_with_its_own_limits(axis: int) -> None:
    """As the simulation of that axis alone, and the others stay where they are."""
    dt = 1e-3
    v, a, j, _ = limits(axis)
    before = alone(axis, (0.1 if axis > 2 else 0.0, 0.4 * v, -0.3 * a), 2.0)
    guard = guard_at(dt, before)
    outputs = [guard.stop(2.0 + n * dt) for n in range(1, 2000)]
    expected = Stop.plan(0.4 * v, -0.3 * a, a, j)
    found = rows(outputs)
    for k in (5, 50, 150, 1500):
        x, u, acceleration = expected.at((k + 1) * dt)
        assert found[k, axis] == pytest.approx(
            (0.1 + x if axis > 2 else x, u, acceleration), abs=1e-5 * v
        )
    others = [k for k in range(6) if k != axis]
    assert np.all(found[:, others] == 0.0)
    assert guard.standing
