"""Shares by losses: sums, priors, and the bound on what the mean of all loses."""

from math import exp, log

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing.committee.weights import WeightParameters, Weights

losses = st.lists(
    st.tuples(*[st.floats(0.0, 1e4) | st.floats(0.0, 3.0)] * 4), min_size=1, max_size=80
)


def constant(eta: float, memory: float = 5.0) -> WeightParameters:
    """With eta = c / (least + floor) as good as constant."""
    return WeightParameters(memory, contrast=eta * 1e15, floor=1e15)


@given(losses, st.sampled_from([1e-3, 0.01, 1.0]))
def test_shares_sum_to_one(history: list[tuple[float, ...]], dt: float) -> None:
    weights = Weights(dt, WeightParameters(), [0.0, 100.0, 100.0, 100.0])
    assert sum(weights.shares) == pytest.approx(1.0, abs=1e-12)
    for tick in history:
        weights.step(list(tick))
        assert sum(weights.shares) == pytest.approx(1.0, abs=1e-12)
        assert min(weights.shares) >= 0.0


@given(losses, st.sampled_from([0.01, 0.3, 2.0]), st.sampled_from([0.02, 0.5]))
def test_the_mean_of_all_loses_little_more_than_the_best_for_any_losses(
    history: list[tuple[float, ...]], eta: float, dt: float
) -> None:
    """And so than each: the regret, tick by tick, with (1 - a) / a <= tau / dt in place of tau."""
    parameters, start = constant(eta), [0.0, 100.0, 3.0, 0.0]
    weights = Weights(dt, parameters, start)
    whole, each, n = 0.0, np.zeros(4), len(history)
    for tick in history:
        weights.step(list(tick))
        whole += float(np.dot(weights.shares, tick))
        each += tick
    late = parameters.memory / dt
    for loss, first in zip(each, start, strict=True):
        bound = loss + (n + late) * log(4.0) / eta + late * first
        assert whole <= bound * (1.0 + 1e-9) + 1e-9


def test_the_bound_is_near_what_can_happen() -> None:
    """A best member that was trusted least: a third of what the bound allows is lost."""
    weights, ticks, dt = Weights(0.02, constant(2.0), [0.0, 40.0]), 5000, 0.02
    whole = 0.0
    for _ in range(ticks):
        weights.step([10.0, 0.0])
        whole += weights.shares[0] * 10.0
    bound = (ticks + 5.0 / dt) * log(2.0) / 2.0 + 5.0 / dt * 40.0
    assert 0.3 * bound < whole < bound


@given(losses)
def test_a_member_that_comes_twice_has_twice_the_prior(history: list[tuple[float, ...]]) -> None:
    once, twice = (
        Weights(0.02, WeightParameters(), start) for start in ([0.0, 1.0], [0.0, 1.0, 1.0])
    )
    for a, b, *_ in history:
        once.step([a, b])
        twice.step([a, b, b])
    p, q = once.shares
    one, two, three = twice.shares
    assert two == three
    assert one == pytest.approx(p / (p + 2.0 * q), abs=1e-12)


def test_only_the_ratio_of_losses_counts_above_the_floor() -> None:
    small, large = (Weights(0.02, WeightParameters(), [0.0, 0.0]) for _ in range(2))
    for _ in range(5000):
        small.step([1e3, 2e3])
        large.step([1e6, 2e6])
    assert small.shares == pytest.approx(large.shares, rel=0.01)
    assert small.shares[1] / small.shares[0] == pytest.approx(exp(-2.0), rel=0.01)


def test_losses_are_forgotten_within_the_memory() -> None:
    weights = Weights(0.01, WeightParameters(), [0.0, 100.0])
    for _ in range(500):
        weights.step([0.0, 0.0])
    assert weights.late[1] == pytest.approx(100.0 / np.e, rel=1e-9)


@given(losses)
def test_without_contrast_all_are_alike(history: list[tuple[float, ...]]) -> None:
    weights = Weights(0.02, WeightParameters(contrast=0.0), [0.0, 100.0, 100.0, 100.0])
    for tick in history:
        weights.step(list(tick))
    assert weights.shares == [0.25] * 4


@given(losses)
def test_what_all_have_lost_of_late_is_near_what_the_best_has(
    history: list[tuple[float, ...]],
) -> None:
    weights = Weights(0.02, WeightParameters(), [0.0, 100.0, 100.0, 100.0])
    for tick in history:
        weights.step(list(tick))
        least = min(weights.late)
        mean = float(np.dot(weights.shares, weights.late))
        assert mean <= least + (least + 1.0) * log(4.0) / 2.0 + 1e-9
