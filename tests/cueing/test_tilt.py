"""Gravity as a cue, against the geometry it stands for.

What turns W's up to the force, and what keeps it there.
"""

from math import pi, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from atlas_cueing.cueing.tilt import ForceDirection, aligned, fade_in, misalignment
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Vec3,
    angle_between,
    conjugate,
    dot,
    exp,
    flip,
    from_euler,
    geodesic,
    multiply,
    norm,
    rotate,
    scale,
)
from atlas_cueing.signals import VehicleState

from .vehicles import up_in_cabin

HOLD = 1.5
part = st.floats(-20.0, 20.0)
vectors = st.tuples(part, part, part)
turns = st.tuples(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
AXES: list[Vec3] = [
    (1.0, 0.0, 0.0),
    (0.0, 1.0, 0.0),
    (0.0, 0.0, 1.0),
    (0.6, 0.8, 0.0),
    (0.6, 0.0, 0.8),
]
OPPOSED = [scale(s, axis) for axis in AXES for s in (1.0, -1.0)]


@given(turns, vectors)
def test_aligned_is_the_nearest_cabin_whose_up_is_the_force(turn: Vec3, f_B: Vec3) -> None:
    assume(norm(f_B) > HOLD)
    vehicle = VehicleState(0.0, exp(turn), ZERO, f_B)
    q_WS, level = aligned(vehicle, HOLD), aligned(VehicleState(0.0, exp(turn), ZERO, ZERO), HOLD)
    assert angle_between(up_in_cabin(q_WS), flip(f_B)) < 1e-6
    assert geodesic(level, q_WS) == pytest.approx(
        angle_between(up_in_cabin(level), flip(f_B)), abs=1e-6
    )


def test_aligned_takes_the_attitude_where_there_is_no_force_to_speak_of() -> None:
    q_WS = aligned(VehicleState(0.0, from_euler(2.0, 0.3, -0.4), ZERO, (1.4, 0.0, 0.0)), HOLD)
    assert q_WS == pytest.approx((lambda q: (q[0], q[1], -q[2], -q[3]))(from_euler(0.0, 0.3, -0.4)))


@given(turns, vectors)
def test_misalignment_turns_up_to_the_force_by_the_shortest_way(turn: Vec3, f_S: Vec3) -> None:
    assume(norm(f_S) > 2.0 * HOLD)
    q_WS = exp(turn)
    error = misalignment(q_WS, f_S, HOLD)
    assert angle_between(up_in_cabin(multiply(q_WS, exp(error))), f_S) < 1e-6
    assert norm(error) == pytest.approx(angle_between(up_in_cabin(q_WS), f_S), abs=1e-9)


@pytest.mark.parametrize("up_S", OPPOSED, ids=str)
@pytest.mark.parametrize("off", [0.0, 1e-12, 1e-7])
def test_a_force_straight_against_up_is_turned_to_as_well(up_S: Vec3, off: float) -> None:
    """Half a turn brings up to the force, about an axis across it.

    About the force itself nothing would change.
    """
    q_WS = conjugate(
        exp(scale(angle_between((0.0, 0.0, 1.0), up_S), _across((0.0, 0.0, 1.0), up_S)))
    )
    assert up_in_cabin(q_WS) == pytest.approx(up_S, abs=1e-15)
    f_S = (-9.8 * up_S[0], -9.8 * up_S[1] + off, -9.8 * up_S[2] - off)
    error = misalignment(q_WS, f_S, HOLD)
    assert norm(error) == pytest.approx(pi, abs=1e-6)
    assert angle_between(up_in_cabin(multiply(q_WS, exp(error))), f_S) < 1e-6


def _across(a: Vec3, b: Vec3) -> Vec3:
    """Unit normal to both; any where they are parallel."""
    normal = np.cross(a, b)
    size = float(np.linalg.norm(normal))
    return tuple((normal / size).tolist()) if size > 1e-9 else (0.0, 1.0, 0.0)


@given(st.floats(0.0, 1e9))
def test_presence_goes_from_nought_to_one_between_hold_and_twice_that(force: float) -> None:
    there = fade_in(force, HOLD)
    assert 0.0 <= there <= 1.0
    assert there == (0.0 if force <= HOLD else 1.0 if force >= 2.0 * HOLD else there)
    assert fade_in(1.001 * force, HOLD) >= there - 1e-12


def test_presence_has_level_ends_and_a_half_in_the_middle() -> None:
    h = 1e-5 * HOLD
    assert fade_in(HOLD + h, HOLD) < 1e-8
    assert 1.0 - fade_in(2.0 * HOLD - h, HOLD) < 1e-8
    assert fade_in(1.5 * HOLD, HOLD) == pytest.approx(0.5)


def test_misalignment_fades_with_the_presence() -> None:
    for size in (0.5, 1.51, 2.0, 2.5, 3.1, 50.0):
        error = misalignment(IDENTITY, (0.0, 0.6 * size, 0.8 * size), HOLD)
        assert norm(error) == pytest.approx(
            fade_in(size, HOLD) * angle_between((0.0, 0.6, 0.8), (0.0, 0.0, 1.0))
        )


@pytest.mark.parametrize("w_S", [ZERO, (0.3, -2.0, 1.0)])
def test_the_rate_that_carries_keeps_up_on_the_force_and_turns_with_the_vehicle_about_it(
    w_S: Vec3,
) -> None:
    """u' = -w x u by finite differences of the filtered force, and w . u = w_vehicle . u."""
    dt, direction = 1e-3, ForceDirection(1e-3, 2.0 * pi, HOLD, (3.0, 0.0, 9.0))
    u, w = [], []
    for i in range(4000):
        t = i * dt
        filtered = direction.step(
            (3.0 + 4.0 * sin(3.0 * t), 5.0 * sin(2.0 * t), 9.0 + 4.0 * sin(5.0 * t))
        )
        u.append(np.array(filtered) / norm(filtered))
        w.append(direction.carried(w_S))
        assert dot(w[-1], tuple(u[-1])) == pytest.approx(dot(w_S, tuple(u[-1])), abs=1e-12)
    turning = np.gradient(np.array(u), dt, axis=0)
    assert np.max(np.linalg.norm(turning, axis=1)) > 0.5
    assert np.max(np.abs(turning + np.cross(w, u))[2:-2]) < 1e-4


def test_the_rate_that_carries_is_the_vehicle_s_near_zero_force() -> None:
    w_S = (0.3, -0.2, 0.9)
    for size, share in (
        (0.0, 0.0),
        (1e-300, 0.0),
        (HOLD, 0.0),
        (1.5 * HOLD, 0.5),
        (2.0 * HOLD, 1.0),
    ):
        direction = ForceDirection(0.01, 6.0, HOLD, (0.0, 0.0, size))
        assert direction.carried(w_S) == pytest.approx(
            ((1.0 - share) * 0.3, -(1.0 - share) * 0.2, 0.9)
        )


@pytest.mark.parametrize("omega", [0.5, 3.0, 8.0])
def test_a_force_that_turns_is_followed_with_the_filter_s_own_lag(omega: float) -> None:
    """The filter 1 / (1 + i omega / b)^2 turns a vector back by 2 atan(omega / b) only."""
    dt, b = 1e-3, 2.0 * pi
    direction = ForceDirection(dt, b, HOLD, (0.0, 0.0, 10.0))
    for i in range(1, int(5.0 / dt)):
        f_S = rotate(exp((0.0, omega * i * dt, 0.0)), (0.0, 0.0, 10.0))
        filtered = direction.step(f_S)
    assert angle_between(filtered, f_S) == pytest.approx(2.0 * np.arctan(omega / b), abs=omega * dt)
    assert norm(filtered) == pytest.approx(10.0 / (1.0 + (omega / b) ** 2), rel=1e-3)
    assert direction.carried(ZERO) == pytest.approx((0.0, -omega, 0.0), abs=1e-2)
