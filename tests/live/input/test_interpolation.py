"""States between two samples."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.live.input.interpolation import Interpolation
from atlas_cueing.rotation import IDENTITY, exp, geodesic, multiply, normalise
from atlas_cueing.signals import VehicleState

from ..motions import Motion, angles, forces, rates, rms, turned_rates

number = st.floats(-6.0, 6.0)
vector = st.tuples(number, number, number)


@given(vector, vector, vector, vector, vector, st.floats(0.001, 0.1))
def test_both_samples_are_met(turn, w0, w1, error, f1, h) -> None:  # type: ignore[no-untyped-def]
    """Whatever they are, also when the rates do not explain the attitude."""
    before = VehicleState(2.0, exp(turn), w0, (0.0, 0.0, -9.8))
    now = VehicleState(
        2.0 + h, normalise(multiply(exp(turn), exp(tuple(0.1 * e for e in error)))), w1, f1
    )
    between = Interpolation(before, now)
    first, last = between.at(2.0, 7.0), between.at(2.0 + h, 7.5)
    assert geodesic(first.q_NB, before.q_NB) < 1e-9
    assert geodesic(last.q_NB, now.q_NB) < 1e-9
    assert (first.w_NB_B, first.f_B) == (before.w_NB_B, before.f_B)
    assert last.w_NB_B == pytest.approx(now.w_NB_B, abs=1e-9)
    assert last.f_B == pytest.approx(now.f_B, abs=1e-9)
    assert (first.time, last.time) == (7.0, 7.5)


def read(
    rate_hz: int, loop_hz: int = 1000, duration: float = 3.0
) -> tuple[list[VehicleState], list[VehicleState]]:
    """The motion sampled at one rate and read at another, and the truth."""
    motion = Motion(duration + 0.2)
    got, truth = [], []
    for k in range(1, int(duration * loop_hz)):
        t = k / loop_hz
        j = int(t * rate_hz)
        between = Interpolation(motion.at(j / rate_hz), motion.at((j + 1) / rate_hz))
        got.append(between.at(t, t))
        truth.append(motion.at(t))
    return got, truth


@pytest.mark.parametrize(
    ("rate_hz", "attitude", "rate", "force"),
    [(30, 4e-5, 3e-3, 7e-3), (60, 5e-6, 7e-4, 2e-3), (120, 6e-7, 2e-4, 5e-4)],
)
def test_error_falls_with_the_interval(
    rate_hz: int, attitude: float, rate: float, force: float
) -> None:
    """Third order in the attitude, second in rates and force."""
    got, truth = read(rate_hz)
    assert float(np.max(angles(got, truth))) < attitude
    assert rms(rates(got) - rates(truth)) < rate
    assert rms(forces(got) - forces(truth)) < force


@pytest.mark.parametrize("rate_hz", [30, 120])
def test_rates_are_the_derivative_of_the_attitude(rate_hz: int) -> None:
    got, _ = read(rate_hz)
    middle = 0.5 * (rates(got)[1:] + rates(got)[:-1])
    assert rms(turned_rates(got) - middle) < 40.0 / rate_hz**2


def test_the_attitude_of_forward_euler_does_not_shake_the_rates() -> None:
    """A steady angular acceleration, its attitude a step behind: rates stay a straight line."""
    h, alpha = 1.0 / 120.0, 5.0
    states, q = [], IDENTITY
    for k in range(40):
        w = (alpha * h * k, 0.0, 0.0)
        states.append(VehicleState(k * h, q, w, (0.0, 0.0, -9.8)))
        q = multiply(q, exp((h * w[0], 0.0, 0.0)))
    got = []
    for k, state in enumerate(states[:-1]):
        between = Interpolation(state, states[k + 1])
        got += [between.at(state.time + i * h / 8, state.time + i * h / 8) for i in range(8)]
    acceleration = np.diff(rates(got)[:, 0]) * 8 / h
    assert acceleration == pytest.approx(alpha, abs=1e-6)
    assert turned_rates(got)[:, 0] == pytest.approx(rates(got)[:-1, 0], abs=alpha * h)


def test_more_than_half_a_turn_between_samples() -> None:
    """The rates tell which way round, and how often."""
    spin = (45.0, 0.0, 0.0)
    before = VehicleState(0.0, IDENTITY, spin, (0.0, 0.0, -9.8))
    now = replace(before, time=0.1, q_NB=exp((4.5, 0.0, 0.0)))
    assert geodesic(Interpolation(before, now).at(0.05, 0.05).q_NB, exp((2.25, 0.0, 0.0))) < 1e-9
