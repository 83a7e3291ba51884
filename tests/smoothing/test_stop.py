"""The closed-form stop against pinned distances, simulation, ruckig and brute force."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from ruckig import ControlInterface, InputParameter, Ruckig, Trajectory

from atlas_cueing.smoothing import Stop
from atlas_cueing.smoothing.stop import approach, stop_bound

ROWS = json.loads((Path(__file__).parents[1] / "oracles" / "stop_distance.json").read_text())[
    "rows"
]

speed = st.floats(-50.0, 50.0) | st.floats(-1e-6, 1e-6)
share = st.floats(-1.0, 1.0) | st.sampled_from([-1.0, 0.0, 1.0])
bound = st.floats(0.5, 100.0)
jerk = st.floats(1.0, 1000.0)


def simulate(stop: Stop, n: int = 2000) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """t, p, v, a of the phases, each by the trapezoid rule for p on n exact steps of v and a."""
    t, p, v, a = [0.0], [0.0], [stop.v], [stop.a]
    for j, duration in stop.phases:
        h = duration / n
        for _ in range(n if duration else 0):
            v.append(v[-1] + h * a[-1] + 0.5 * h * h * j)
            a.append(a[-1] + h * j)
            p.append(p[-1] + 0.5 * h * (v[-2] + v[-1]) - h * h / 12.0 * (a[-1] - a[-2]))
            t.append(t[-1] + h)
    return np.array(t), np.array(p), np.array(v), np.array(a)


def shortest_by_ruckig(v: float, a: float, a_max: float, j_max: float) -> float:
    """Duration of the time-optimal way to v = a = 0."""
    inputs, trajectory = InputParameter(1), Trajectory(1)
    inputs.control_interface = ControlInterface.Velocity
    inputs.current_velocity, inputs.current_acceleration = [v], [a]
    inputs.max_velocity, inputs.max_acceleration, inputs.max_jerk = [1e3], [a_max], [j_max]
    Ruckig(1).calculate(inputs, trajectory)
    return float(trajectory.duration)


@pytest.mark.parametrize("row", ROWS)
def test_pinned_distances(row: dict[str, float]) -> None:
    stop = Stop.plan(
        row["v_m_s"], row["a_m_s2"], row["max_acceleration_m_s2"], row["max_jerk_m_s3"]
    )
    assert stop.at(stop.duration)[0] == pytest.approx(row["stop_distance_m"], rel=1e-12)
    assert simulate(stop)[1][-1] == pytest.approx(row["stop_distance_m"], rel=1e-9)
    mirrored = Stop.plan(
        -row["v_m_s"], -row["a_m_s2"], row["max_acceleration_m_s2"], row["max_jerk_m_s3"]
    )
    assert mirrored.at(mirrored.duration)[0] == -stop.at(stop.duration)[0]


@given(speed, share, bound, jerk)
def test_the_phases_end_at_rest_inside_the_bounds(
    v: float, k: float, a_max: float, j_max: float
) -> None:
    stop = Stop.plan(v, k * a_max, a_max, j_max)
    assert len(stop.phases) == 3
    assert all(duration >= 0.0 and abs(j) in (0.0, j_max) for j, duration in stop.phases)
    p, v_end, a_end = 0.0, v, k * a_max
    for j, t in stop.phases:
        p, v_end, a_end = (
            p + v_end * t + a_end * t**2 / 2.0 + j * t**3 / 6.0,
            v_end + a_end * t + j * t**2 / 2.0,
            a_end + j * t,
        )
        assert abs(a_end) <= a_max * (1.0 + 1e-12)
    scale = abs(v) + a_max**2 / j_max
    assert v_end == pytest.approx(0.0, abs=1e-12 * scale)
    # a peak that is a difference of two near equals: sqrt(eps)
    assert a_end == pytest.approx(0.0, abs=1e-7 * a_max)
    assert stop.at(stop.duration)[0] == pytest.approx(p, abs=1e-12 * scale * (1.0 + stop.duration))


@given(speed, share, bound, jerk)
def test_no_stop_is_shorter(v: float, k: float, a_max: float, j_max: float) -> None:
    stop = Stop.plan(v, k * a_max, a_max, j_max)
    assert stop.duration == pytest.approx(
        shortest_by_ruckig(v, k * a_max, a_max, j_max), rel=1e-7, abs=1e-7
    )


def test_no_stop_is_shorter_by_brute_force() -> None:
    """Any three phases of jerk +-J, 0, +-J that end at rest take as long or longer."""
    random = np.random.default_rng(5)
    a_max, j_max, found = 3.0, 20.0, 0
    for v, a in zip(random.uniform(-1.0, 1.0, 40), random.uniform(-a_max, a_max, 40), strict=True):
        best = Stop.plan(v, a, a_max, j_max).duration
        for first in (-j_max, j_max):
            t1 = np.linspace(0.0, 2.0 * a_max / j_max, 400)
            peak = a + first * t1
            t3 = np.abs(peak) / j_max  # the last phase brings the acceleration to zero
            left = v + a * t1 + 0.5 * first * t1**2 + 0.5 * peak * t3
            with np.errstate(divide="ignore", invalid="ignore"):
                t2 = -left / peak
            fits = (np.abs(peak) <= a_max) & (t2 >= 0.0)
            found += int(fits.sum())
            assert np.all((t1 + t2 + t3)[fits] >= best - 1e-9)
    assert found > 1000


@given(speed, share, bound, jerk, st.floats(0.0, 1.2))
def test_at_follows_the_simulation(
    v: float, k: float, a_max: float, j_max: float, when: float
) -> None:
    stop = Stop.plan(v, k * a_max, a_max, j_max)
    t, p, speeds, accelerations = simulate(stop, 200)
    now = when * stop.duration
    found = stop.at(now)
    scale = 1.0 + abs(v) + a_max + np.ptp(p)
    step = stop.duration / 200.0
    assert found[0] == pytest.approx(np.interp(now, t, p), abs=1e-9 * scale + a_max * step**2)
    assert found[1] == pytest.approx(np.interp(now, t, speeds), abs=1e-7 * scale + j_max * step**2)
    assert found[2] == pytest.approx(np.interp(now, t, accelerations), abs=1e-6 * scale)


@given(speed, share, bound, jerk)
def test_span_holds_every_point_of_the_way_and_no_more(
    v: float, k: float, a_max: float, j_max: float
) -> None:
    stop = Stop.plan(v, k * a_max, a_max, j_max)
    low, high = stop.span()
    p = np.array([stop.at(t)[0] for t in np.linspace(0.0, stop.duration, 400)])
    scale = abs(v) * stop.duration + a_max * stop.duration**2
    assert low <= p.min() + 1e-12 * scale
    assert high >= p.max() - 1e-12 * scale
    coarse = scale / 400.0**2
    assert low == pytest.approx(p.min(), abs=coarse + 1e-12)
    assert high == pytest.approx(p.max(), abs=coarse + 1e-12)


def test_span_of_a_stop_that_first_runs_backwards() -> None:
    """With v = -0.1 m/s and a = 3 m/s^2 it turns round and overshoots its start.

    Neither end of the span is an end of the way.
    """
    stop = Stop.plan(-0.1, 3.0, 3.0, 10.0)
    low, high = stop.span()
    p = simulate(stop)[1]
    assert low < -1e-3
    assert high > 1e-3
    assert (low, high) == (pytest.approx(p.min(), abs=1e-6), pytest.approx(p.max(), abs=1e-6))


@given(speed, share, bound, jerk, st.floats(0.0, 1.0))
def test_the_rest_of_a_stop_is_the_stop_of_its_rest(
    v: float, k: float, a_max: float, j_max: float, when: float
) -> None:
    """One tick along a certified stop is a certified state.

    This keeps the stage inside its travel for ever.
    """
    stop = Stop.plan(v, k * a_max, a_max, j_max)
    p, v1, a1 = stop.at(when * stop.duration)
    rest = Stop.plan(v1, min(max(a1, -a_max), a_max), a_max, j_max)
    scale = abs(v) * stop.duration + a_max * stop.duration**2 + 1e-9
    assert rest.duration == pytest.approx(
        (1.0 - when) * stop.duration, abs=1e-6 * stop.duration + 1e-6
    )
    assert p + rest.at(rest.duration)[0] == pytest.approx(
        stop.at(stop.duration)[0], abs=1e-9 * scale
    )
    low, high = stop.span()
    assert p + rest.span()[0] >= low - 1e-9 * scale
    assert p + rest.span()[1] <= high + 1e-9 * scale


@pytest.mark.parametrize("v", [0.0, -0.0])
def test_standing_still_is_a_stop(v: float) -> None:
    stop = Stop.plan(v, 0.0, 3.0, 30.0)
    assert stop.duration == 0.0
    assert stop.at(0.0) == stop.at(1.0) == (0.0, 0.0, 0.0)
    assert stop.span() == (0.0, 0.0)


@given(speed, share, bound, jerk)
def test_stop_bound_holds_the_span(v: float, k: float, a_max: float, j_max: float) -> None:
    """By the simulated way, not by the span itself.

    And not so loose that it never settles anything.
    """
    p = simulate(Stop.plan(v, k * a_max, a_max, j_max), 200)[1]
    assert np.max(np.abs(p)) <= stop_bound(v, k * a_max, a_max, j_max) * (1.0 + 1e-9) + 1e-12
    assert (
        stop_bound(v, 0.0, a_max, j_max)
        <= 0.5 * abs(v) * (abs(v) / a_max + a_max / j_max) * (1.0 + 1e-9) + 1e-300
    )


distances = st.floats(1e-9, 1e3)
gains = st.floats(0.1, 1e3)


def three_laws(
    distance: float, gain: float, a_max: float, j_max: float
) -> tuple[float, float, float]:
    """Speeds by the gain, by the acceleration and by bisection of the jerk-limited `Stop`."""
    corner = a_max / gain**2
    by_acceleration = (
        gain * distance if distance <= corner else np.sqrt(2.0 * a_max * (distance - 0.5 * corner))
    )
    low, high = 0.0, 1.0 + np.sqrt(2.0 * a_max * distance) + (j_max * distance**2) ** (1.0 / 3.0)
    for _ in range(80):
        middle = 0.5 * (low + high)
        stop = Stop.plan(middle, 0.0, a_max, j_max)
        low, high = (middle, high) if stop.at(stop.duration)[0] <= distance else (low, middle)
    return gain * distance, float(by_acceleration), low


@given(distances, gains, bound, jerk)
def test_approach_is_the_least_of_its_three_laws(
    distance: float, gain: float, a_max: float, j_max: float
) -> None:
    closing, _ = approach(distance, gain, a_max, j_max)
    assert closing == pytest.approx(min(three_laws(distance, gain, a_max, j_max)), rel=1e-7)


@given(distances, gains, bound, jerk)
def test_approach_stops_within_the_distance_and_brakes_within_its_acceleration(
    distance: float, gain: float, a_max: float, j_max: float
) -> None:
    """Its deceleration is speed times slope."""
    closing, slope = approach(distance, gain, a_max, j_max)
    assert 0.0 < closing <= gain * distance
    assert 0.0 < slope <= gain * (1.0 + 1e-12)
    assert closing * slope <= a_max * (1.0 + 1e-12)
    stop = Stop.plan(closing, 0.0, a_max, j_max)
    assert stop.at(stop.duration)[0] <= distance * (1.0 + 1e-9)


@given(distances, gains, bound, jerk)
def test_the_slope_of_the_approach_is_its_derivative(
    distance: float, gain: float, a_max: float, j_max: float
) -> None:
    h = 1e-5 * distance
    slope = approach(distance, gain, a_max, j_max)[1]
    either_side = [approach(distance + s * h, gain, a_max, j_max) for s in (-1.0, 1.0)]
    assert either_side[0][0] <= either_side[1][0], "further off, never slower"
    assume(all(x[1] == pytest.approx(slope, rel=1e-3) for x in either_side))  # not at the corner
    assert (either_side[1][0] - either_side[0][0]) / (2.0 * h) == pytest.approx(slope, rel=1e-4)


@given(gains, bound, jerk)
def test_the_approach_has_no_jump_anywhere(gain: float, a_max: float, j_max: float) -> None:
    """At the corners of its laws the speed is continuous.

    Where the gain meets the acceleration the slope is, too.
    """
    corners = [a_max / gain**2, j_max / gain**3, a_max**3 / j_max**2]
    for corner in corners:
        below, above = (approach(corner * k, gain, a_max, j_max) for k in (1.0 - 1e-9, 1.0 + 1e-9))
        assert below[0] == pytest.approx(above[0], rel=1e-7)
    if a_max / gain**2 < 0.9 * j_max / gain**3 and gain * a_max < 0.9 * j_max:
        below, above = (
            approach(corners[0] * k, gain, a_max, j_max) for k in (1.0 - 1e-9, 1.0 + 1e-9)
        )
        assert below[1] == pytest.approx(above[1], rel=1e-6)


def test_approach_at_the_end_and_where_the_acceleration_saturates() -> None:
    assert approach(0.0, 4.0, 3.0, 30.0) == (0.0, 4.0)
    assert approach(-1.0, 4.0, 3.0, 30.0) == (0.0, 4.0)
    corner = 3.0**3 / 30.0**2
    below, above = (approach(corner * k, 1e9, 3.0, 30.0) for k in (1.0 - 1e-12, 1.0 + 1e-12))
    assert below == (pytest.approx(above[0]), pytest.approx(above[1]))
    assert below[0] == pytest.approx(3.0**2 / 30.0)


@pytest.mark.parametrize("gain", [1.0, 4.0, 10.0])
@pytest.mark.parametrize("start", [0.3, 2.0, 100.0])
def test_a_run_down_the_approach_arrives_and_brakes_within_the_acceleration(
    gain: float, start: float
) -> None:
    """e' = -g(e) decelerates with g g', and uses most of what it may."""
    e, h, worst, before = start, 1e-3, 0.0, approach(start, gain, 3.0, 30.0)[0]
    for _ in range(30000):
        closing, _ = approach(e, gain, 3.0, 30.0)
        worst = max(worst, (before - closing) / h)
        before = closing
        e -= h * closing
    assert 0.0 <= e < 1e-7
    assert worst <= 3.0 * (1.0 + 2.0 * gain * h)  # what a step of Euler's adds to it
    assert worst > (0.8 * 3.0 if start > 1.0 and gain > 1.0 else 0.2)
