"""The cabin: the slow turn inside its bounds for any wish, and one motion with the vehicle's."""

from math import e, pi, radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing import SlowTurnParameters
from atlas_cueing.cueing.cabin import Cabin, SlowTurn, cabin_rate, upright
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Vec3,
    conjugate,
    exp,
    flip_rotation,
    from_euler,
    geodesic,
    log,
    multiply,
    rotate,
)
from atlas_cueing.signals import VehicleState

PARAMETERS = SlowTurnParameters()
part = st.floats(-1e6, 1e6) | st.floats(-0.1, 0.1)
wishes = st.lists(
    st.tuples(st.tuples(part, part, part), st.tuples(part, part, part), st.integers(1, 300)),
    min_size=1,
    max_size=8,
)


@given(wishes, st.sampled_from([1e-3, 1.0 / 120.0, 0.05]))
def test_the_slow_turn_keeps_its_rate_and_its_acceleration(
    wishes: list[tuple[Vec3, Vec3, int]], dt: float
) -> None:
    slow, before = SlowTurn(dt, PARAMETERS), np.zeros(3)
    for error, w, ticks in wishes:
        for _ in range(ticks):
            now = np.array(slow.step(error, w))
            assert np.linalg.norm(now) <= PARAMETERS.rate * (1.0 + 1e-9)
            assert np.linalg.norm(now - before) / dt <= 2.0 * PARAMETERS.rate / (
                e * PARAMETERS.smoothing
            ) * (1.0 + 1e-6)
            before = now


def test_both_bounds_are_reached() -> None:
    """A wish that flips from one end of the ball to the other."""
    dt, slow, w = 1e-3, SlowTurn(1e-3, PARAMETERS), []
    for sign in (1.0, -1.0):
        w += [slow.step((0.0, sign * 9.0, 0.0), ZERO)[1] for _ in range(4000)]
    assert max(w) == pytest.approx(PARAMETERS.rate, rel=1e-5)
    assert np.max(np.abs(np.diff(w))) / dt == pytest.approx(
        2.0 * PARAMETERS.rate / (e * PARAMETERS.smoothing), rel=1e-3
    )


def test_the_wish_is_the_error_over_the_time_plus_the_lasting_rate() -> None:
    slow, error, w = (
        SlowTurn(0.01, SlowTurnParameters(1.0, 4.0, 0.1)),
        (0.4, 0.0, -0.2),
        (0.0, 0.3, 0.1),
    )
    for _ in range(400):
        found = slow.step(error, w)
    assert found == pytest.approx((0.1, 0.3, 0.05))


@pytest.mark.parametrize("w_S", [(0.7, -0.4, 1.1), (0.0, 3.0, 0.0), ZERO])
def test_a_constant_rate_is_carried_exactly(w_S: Vec3) -> None:
    cabin, start = (
        Cabin(0.02, from_euler(0.3, 0.2, 0.1), w_S, PARAMETERS),
        from_euler(0.3, 0.2, 0.1),
    )
    for i in range(1, 500):
        cabin.carry(w_S)
        cabin.correct(ZERO)
        truth = multiply(start, exp(tuple(0.02 * i * x for x in w_S)))  # type: ignore[arg-type]
        assert geodesic(cabin.q_WS, truth) < 1e-9
    q_WS, w_WS_W = cabin.cue
    assert w_WS_W == pytest.approx(rotate(q_WS, w_S))


def test_an_error_is_taken_back_in_its_time_without_overshoot() -> None:
    """Beyond the rate at 3 deg/s; within it in a few time constants."""
    dt, cabin, target, left = (
        0.01,
        Cabin(0.01, IDENTITY, ZERO, PARAMETERS),
        exp((0.0, radians(20.0), 0.0)),
        [],
    )
    for _ in range(int(25.0 / dt)):
        cabin.carry(ZERO)
        cabin.correct(log(multiply(conjugate(cabin.q_WS), target)))
        left.append(log(multiply(conjugate(cabin.q_WS), target))[1])
    # the filter's delay: 2 smoothing
    assert left[int(3.0 / dt)] == pytest.approx(radians(20.0 - 3.0 * (3.0 - 0.5)), abs=1e-3)
    assert np.min(left) > -1e-3
    assert abs(left[-1]) < 1e-3


def test_turning_and_slow_turning_at_once_are_one_motion() -> None:
    """Halving dt quarters the gap from the integral of the rate.

    The two turns do not commute.
    """
    gaps = []
    for n in (200, 400):
        dt = 8.0 / n
        cabin = Cabin(dt, IDENTITY, (1.0, 0.0, 0.0), SlowTurnParameters(0.2, 1.0, 0.3))
        q, before = cabin.q_WS, cabin.cue[1]
        for _ in range(n):
            cabin.carry((1.0, 0.0, 0.0))
            cabin.correct((0.0, 1.0, 1.0))
            now = cabin.cue[1]
            q = multiply(
                exp(tuple(0.5 * dt * (a + b) for a, b in zip(before, now, strict=True))), q
            )  # type: ignore[arg-type]
            before = now
        gaps.append(geodesic(q, cabin.q_WS))
    assert gaps[0] / gaps[1] > 3.0


@pytest.mark.parametrize("heading", [0.0, 1.0, -3.0, pi])
def test_upright_takes_off_the_heading_alone(heading: float) -> None:
    assert (
        geodesic(upright(from_euler(heading, 0.4, -0.9)), flip_rotation(from_euler(0.0, 0.4, -0.9)))
        < 1e-9
    )


def test_cabin_rate_has_cabin_axes_and_gains() -> None:
    vehicle = VehicleState(0.0, IDENTITY, (0.1, 0.2, 0.3), (0.0, 0.0, -9.8))
    assert cabin_rate((1.0, 0.5, 2.0), vehicle) == pytest.approx((0.1, -0.1, -0.6))
