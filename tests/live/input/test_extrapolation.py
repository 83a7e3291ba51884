"""States after the last sample: near the truth, without steps, bounded for ever."""

from dataclasses import replace
from itertools import pairwise
from math import inf
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.live.input.arrival_times import ArrivalTimes
from atlas_cueing.live.input.extrapolation import (
    FADING,
    STEEPEST_FORCE,
    STEEPEST_RATE,
    Extrapolation,
)
from atlas_cueing.rotation import IDENTITY, exp, geodesic, norm, subtract
from atlas_cueing.signals import VehicleState, attitude_jump

from ..motions import Array, Motion, angles, forces, rates, rms, turned_rates

DURATION = 4.0
REST = VehicleState(0.0, IDENTITY, (0.0, 0.0, 0.0), (0.0, 0.0, -9.80665))


@pytest.fixture(scope="module")
def motion() -> Motion:
    return Motion(DURATION + 0.5)


def arrive(rate_hz: float, jitter: float) -> tuple[list[float], list[float]]:
    """When samples are taken, and when they arrive: later by up to `jitter` (s), at random."""
    random = Random(1)
    taken = [k / rate_hz for k in range(int(DURATION * rate_hz))]
    return taken, [t + jitter * random.random() for t in taken]


def read(
    motion: Motion, rate_hz: float, loop_hz: float, jitter: float = 0.0, hold: bool = False
) -> tuple[list[VehicleState], list[VehicleState]]:
    """What the loop reads, and the truth, from the first half second on."""
    taken, arrivals = arrive(rate_hz, jitter)
    clock = ArrivalTimes(rate_hz)
    course, last, n = None, None, 0
    got, truth = [], []
    for k in range(1, int(DURATION * loop_hz)):
        t = k / loop_hz
        while n < len(taken) and arrivals[n] <= t:
            last = replace(motion.at(taken[n]), time=clock.time(arrivals[n]))
            if course is None:
                course = Extrapolation(last, 1.0 / rate_hz)
            else:
                course.add(last)
            n += 1
        if course is not None and last is not None and t > 0.5:
            got.append(replace(last, time=t) if hold else course.at(t))
            truth.append(motion.at(t))
    return got, truth


def shaking(states: list[VehicleState]) -> float:
    """Rms of the angular acceleration, by differences, rad/s^2."""
    h = np.diff([state.time for state in states])[:, None]
    return rms(np.diff(rates(states), axis=0) / h)


CASES = [(rate_hz, loop_hz) for rate_hz in (30.0, 60.0, 120.0) for loop_hz in (500.0, 1000.0)]


@pytest.mark.parametrize(("rate_hz", "loop_hz"), CASES)
def test_nearer_and_quieter_than_holding(motion: Motion, rate_hz: float, loop_hz: float) -> None:
    """Second order in the interval, where holding is of the first.

    And it shakes as little as the truth.
    """
    got, truth = read(motion, rate_hz, loop_hz)
    held, _ = read(motion, rate_hz, loop_hz, hold=True)
    assert rms(rates(got) - rates(truth)) < 30.0 / rate_hz**2
    assert rms(rates(got) - rates(truth)) < (11.0 / rate_hz) * rms(rates(held) - rates(truth))
    assert rms(forces(got) - forces(truth)) < (11.0 / rate_hz) * rms(forces(held) - forces(truth))
    assert float(np.max(angles(got, truth))) < 0.05 * float(np.max(angles(held, truth)))
    assert shaking(got) < 1.05 * shaking(truth)
    assert shaking(held) > 2.0 * shaking(truth)


@pytest.mark.parametrize(("rate_hz", "loop_hz"), CASES)
@pytest.mark.parametrize("jitter", [0.001, 0.003])
def test_jitter_does_not_become_acceleration(
    motion: Motion, rate_hz: float, loop_hz: float, jitter: float
) -> None:
    got, truth = read(motion, rate_hz, loop_hz, jitter)
    assert shaking(got) < 1.15 * shaking(truth)
    # the mean of the delays cannot be known
    delayed = [motion.at(state.time - 0.5 * jitter) for state in truth]
    assert rms(rates(got) - rates(delayed)) < 30.0 / rate_hz**2 + jitter
    assert float(np.max(angles(got, delayed))) < 1.2 * jitter


@pytest.mark.parametrize(("rate_hz", "loop_hz"), CASES)
def test_rates_are_the_derivative_of_the_attitude(
    motion: Motion, rate_hz: float, loop_hz: float
) -> None:
    got, _ = read(motion, rate_hz, loop_hz)
    middle = 0.5 * (rates(got)[1:] + rates(got)[:-1])
    assert rms(turned_rates(got) - middle) < 30.0 / rate_hz**2


def steps(states: list[VehicleState]) -> Array:
    """Return what changes from each read to the next.

    Angle beyond what the rates explain, change of rate, change of force.
    """
    found = []
    for a, b in pairwise(states):
        rate, force = norm(subtract(b.w_NB_B, a.w_NB_B)), norm(subtract(b.f_B, a.f_B))
        found.append((attitude_jump(a, b), rate, force))
    return np.array(found)


def test_a_correction_makes_no_step() -> None:
    """A sample off by 1 deg, 0.1 rad/s and 2 m/s^2 is reached within one interval, evenly."""
    course = Extrapolation(REST, 0.03)
    course.add(replace(REST, time=0.03))
    before = [course.at(0.001 * k) for k in range(30, 61)]
    course.add(
        replace(
            REST,
            time=0.06,
            q_NB=exp((0.017, 0.0, 0.0)),
            w_NB_B=(0.0, 0.1, 0.0),
            f_B=(2.0, 0.0, -9.80665),
        )
    )
    after = [course.at(0.001 * k) for k in range(61, 90)]
    angle, rate, force = steps([*before, *after]).max(axis=0)
    assert angle < 1.1 * 0.017 / 30
    assert rate < 2.1 * 0.1 / 30
    assert force < 2.1 * 2.0 / 30
    due = course.at(0.091)
    assert geodesic(due.q_NB, exp((0.017, 0.0, 0.0))) < 0.006  # of the rate it has by now
    assert due.f_B[0] > 2.0


@given(st.integers(0, 2**32))
def test_bounded_for_ever(seed: int) -> None:
    """Rates and force tend to constants, for any samples and however late the next one is."""
    random = Random(seed)
    state, course = REST, Extrapolation(REST, 0.01)
    for k in range(1, 6):
        state = replace(
            state,
            time=0.01 * k + 0.004 * random.random(),
            w_NB_B=(random.uniform(-20, 20), 0.0, random.uniform(-20, 20)),
            f_B=(random.uniform(-90, 90), 0.0, random.uniform(-90, 90)),
        )
        course.add(state)
        course.at(0.01 * k + 0.005)
    interval = 0.016
    reach = interval + FADING
    states = [course.at(0.07 + t) for t in (0.0, 0.02, 0.1, 1.0, 2.0, 3600.0)]
    for got in states:
        assert norm(subtract(got.w_NB_B, state.w_NB_B)) <= STEEPEST_RATE * reach + 1e-9
        assert norm(subtract(got.f_B, state.f_B)) <= STEEPEST_FORCE * reach + 1e-9
        assert norm(got.q_NB[1:]) < inf
        assert sum(c * c for c in got.q_NB) == pytest.approx(1.0, abs=1e-9)
    assert states[-1].w_NB_B == pytest.approx(states[-2].w_NB_B, abs=1e-9)
    assert states[-1].f_B == pytest.approx(states[-2].f_B, abs=1e-9)


def test_a_late_sample_is_bridged(motion: Motion) -> None:
    """25 ms late: nearer to the truth than holding, at 60 Hz."""
    course = Extrapolation(motion.at(0.9), 1.0 / 60.0)
    for k in range(1, 7):
        course.add(motion.at(0.9 + k / 60.0))
        course.at(0.9 + (k + 0.9) / 60.0)
    t = 1.0 + 1.0 / 60.0 + 0.025
    late, truth, last = course.at(t), motion.at(t), motion.at(1.0)
    assert geodesic(late.q_NB, truth.q_NB) < 0.15 * geodesic(last.q_NB, truth.q_NB)
    assert norm(subtract(late.f_B, truth.f_B)) < 0.5 * norm(subtract(last.f_B, truth.f_B))


def test_the_fading_is_the_integral_of_an_exponential() -> None:
    """Rate and attitude of a sample that is overdue, against a numerical integration."""
    course = Extrapolation(REST, 0.01)
    course.add(replace(REST, time=0.01, w_NB_B=(0.05, 0.0, 0.0)))
    course.at(0.01)
    h, w, angle = 1e-5, 0.05, 0.0
    for k in range(round(0.08 / h)):
        t = (k + 0.5) * h
        slope = 5.0 if t < 0.01 else 5.0 * float(np.exp(-(t - 0.01) / FADING))
        angle += h * (w + 0.5 * h * slope)
        w += h * slope
    got = course.at(0.09)
    assert got.w_NB_B[0] == pytest.approx(w, rel=1e-4)
    assert geodesic(got.q_NB, exp((angle, 0.0, 0.0))) < 1e-6
