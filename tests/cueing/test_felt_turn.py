"""The law of the felt turn: its gain, its linear motion and its bounds."""

from math import inf, radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import solve_continuous_are
from scipy.signal import lsim

from atlas_cueing.cueing import FeltTurnParameters
from atlas_cueing.cueing.felt_turn import FeltTurn, decaying_gain, lasting_gain
from atlas_cueing.rotation import ZERO, Vec3, add, norm, scale, subtract

from .bilinear_canals import Canals

LAW = FeltTurnParameters()
part = st.floats(-50.0, 50.0) | st.floats(-0.1, 0.1)
vectors = st.tuples(part, part, part)
inputs = st.lists(st.tuples(vectors, vectors, vectors, st.integers(1, 300)), min_size=1, max_size=8)


def follow(turn: FeltTurn, lasting: list[float], dt: float) -> list[tuple[float, float]]:
    """Error left (rad) and extra rate (rad/s) where `lasting` (rad/s) about x is needed."""
    error, before, path = 0.0, 0.0, [(0.0, 0.0)]
    for w, w_before in zip(lasting[1:], lasting, strict=False):
        error += 0.5 * dt * (w + w_before) - dt * before
        extra = turn.step((error, 0.0, 0.0), (w, 0.0, 0.0), ZERO)[0]
        error -= 0.5 * dt * (extra - before)
        before = extra
        path.append((error, extra))
    return path


@pytest.mark.parametrize("response", [0.1, 1.0, 3.0])
@pytest.mark.parametrize("canals", [0.5, 5.73, 1000.0])
def test_the_gains_are_those_of_the_riccati_equation(response: float, canals: float) -> None:
    """Of y' R y with R = 1 and lambda^2 e^2."""
    a, b = np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[-1.0], [-1.0 / canals]])
    riccati = solve_continuous_are(a, b, np.diag([response**2, 0.0]), np.eye(1))
    gains = -(b.T @ riccati)[0]
    assert gains == pytest.approx([response, lasting_gain(response, canals)], rel=1e-6)


@pytest.mark.parametrize("lasting", [0.1, 1.0, 30.0])
@pytest.mark.parametrize("response", [0.1, 1.0, 3.0])
@pytest.mark.parametrize("canals", [0.5, 5.73, 1000.0])
def test_the_gain_of_a_rate_that_decays_is_that_of_the_riccati_equation(
    response: float, canals: float, lasting: float
) -> None:
    """States e, z and w; z and w cost nothing by themselves."""
    a = np.array([[0.0, -1.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, -1.0 / lasting]])
    b = np.array([[-1.0], [1.0 / canals], [0.0]])
    riccati = solve_continuous_are(a, b, np.diag([response**2, 0.0, 0.0]), np.eye(1))
    gains = -(b.T @ riccati)[0]
    k, k_w = lasting_gain(response, canals), decaying_gain(response, canals, lasting)
    assert gains == pytest.approx([response, -k, k_w], rel=1e-6)


def test_the_gain_of_a_rate_that_decays_within_a_second() -> None:
    assert decaying_gain(1.0, 5.73, 1.0) == pytest.approx(0.4972, abs=5e-5)
    assert decaying_gain(1.0, 5.73, inf) == lasting_gain(1.0, 5.73)
    assert decaying_gain(1.0, inf, 1.0) == 0.5  # lambda tau / (1 + lambda tau)


def test_endless_canals_feel_all_of_a_lasting_rate() -> None:
    assert lasting_gain(1.0, inf) == 1.0


def test_a_ramp_is_followed_as_the_linear_system_does() -> None:
    """States e, z, y, y'; a wish small enough for no bound."""
    dt, k, tau, canals = 1e-3, lasting_gain(1.0, LAW.canals), LAW.smoothing, LAW.canals
    time = dt * np.arange(20001)
    ramp = 1e-3 * time
    a = np.array(
        [
            [0.0, -1.0, -1.0, 0.0],
            [0.0, 0.0, 1.0 / canals, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [LAW.response / tau**2, -k / tau**2, -1.0 / tau**2, -2.0 / tau],
        ]
    )
    b = np.array([[1.0], [0.0], [0.0], [k / tau**2]])
    out = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 1.0, 0.0]])
    _, theory, _ = lsim((a, b, out, np.zeros((2, 1))), ramp, time)
    path = follow(FeltTurn(dt, LAW), ramp.tolist(), dt)
    assert np.allclose(path, theory, atol=5e-3 * np.max(np.abs(theory), axis=0))


def test_a_lasting_turn_is_made_whole_and_no_more_felt() -> None:
    """1 deg/s: after 30 s the extra rate is all of it, of which 0.0051 deg/s is felt.

    That is what the slow pole leaves: T p A exp(-p t) with p = 0.177 1/s and A = 1.02.
    """
    dt, canals = 0.01, Canals(0.01)
    path = follow(FeltTurn(dt, LAW), [radians(1.0)] * 3001, dt)
    felt = [canals.feel((extra, 0.0, 0.0))[0] for _, extra in path]
    assert path[-1][1] == pytest.approx(radians(1.0), abs=radians(0.0015))
    assert felt[-1] == pytest.approx(radians(0.0051), abs=radians(0.0002))


@given(inputs, st.sampled_from([1e-3, 1.0 / 120.0, 0.05]))
def test_no_more_is_felt_than_the_bound_for_any_input(
    inputs: list[tuple[Vec3, Vec3, Vec3, int]], dt: float
) -> None:
    turn, canals, most = FeltTurn(dt, LAW), Canals(dt), 0.0
    for error, lasting, vehicle, ticks in inputs:
        bound = LAW.felt + LAW.rate_gain * norm(vehicle) + LAW.error_gain * norm(error)
        most = max(most, min(bound, LAW.extra))
        for _ in range(ticks):
            extra = turn.step(error, lasting, vehicle)
            assert norm(canals.feel(extra)) <= most * (1.0 + 1e-9) + 1e-12
            assert norm(extra) <= LAW.extra * (1.0 + (2.0 * LAW.smoothing + dt) / LAW.canals)


def test_the_bound_is_reached() -> None:
    """An error that cannot be taken back is turned against with all that may be felt."""
    turn, canals = FeltTurn(0.01, LAW), Canals(0.01)
    felt = [norm(canals.feel(turn.step((1.0, 0.0, 0.0), ZERO, ZERO))) for _ in range(300)]
    assert felt[-1] == pytest.approx(LAW.felt + LAW.error_gain, rel=1e-6)


def test_a_force_that_tumbles_for_ever_takes_the_extra_rate_to_its_limit() -> None:
    turn, canals = FeltTurn(0.01, LAW), Canals(0.01)
    for _ in range(20000):
        extra = turn.step((3.0, 0.0, 0.0), (20.0, 0.0, 0.0), ZERO)
        assert norm(extra) <= LAW.extra * (1.0 + 2.0 * LAW.smoothing / LAW.canals)
        felt = canals.feel(extra)
    assert norm(extra) == pytest.approx(LAW.extra, rel=1e-3)
    assert norm(felt) < 1e-3


@given(inputs)
def test_endless_canals_make_it_a_bound_on_the_rate(
    inputs: list[tuple[Vec3, Vec3, Vec3, int]],
) -> None:
    law = FeltTurnParameters(canals=inf, rate_gain=0.0, error_gain=0.0)
    turn = FeltTurn(0.01, law)
    for error, lasting, vehicle, ticks in inputs:
        for _ in range(ticks):
            assert norm(turn.step(error, lasting, vehicle)) <= law.felt * (1.0 + 1e-9)


def test_it_is_linear_within_its_bounds() -> None:
    """Half the error, half the turn: so left is as right and no direction is preferred."""
    one, half = FeltTurn(0.01, LAW), FeltTurn(0.01, LAW)
    for i in range(300):
        error = (0.02 * np.sin(0.02 * i), 0.01, -0.02 * np.cos(0.03 * i))
        whole = one.step(error, scale(0.5, error), ZERO)
        against = half.step(scale(-0.5, error), scale(-0.25, error), ZERO)
        assert norm(subtract(whole, scale(-2.0, against))) < 1e-12
        assert norm(add(whole, scale(2.0, against))) < 1e-12
