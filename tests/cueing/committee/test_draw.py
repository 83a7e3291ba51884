"""The turn to the members' mean, and its bounds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing.committee.draw import DRAW, Draw, turn_to
from atlas_cueing.rotation import ZERO, Vec3, add, angle_between, conjugate, exp, norm, rotate

from ..bilinear_canals import Canals
from ..test_felt_turn import vectors

UP: Vec3 = (0.0, 0.0, 1.0)
inputs = st.lists(
    st.tuples(vectors, vectors, st.floats(0.0, 50.0), vectors, st.integers(1, 60)),
    min_size=1,
    max_size=8,
)


@given(inputs, st.sampled_from([1e-3, 1.0 / 120.0, 0.05]))
def test_no_more_is_felt_than_the_members_feel_and_the_bound_for_any_input(
    inputs: list[tuple[Vec3, Vec3, float, Vec3, int]], dt: float
) -> None:
    draw, canals = Draw(dt, DRAW), Canals(dt)
    for error, mean, felt, vehicle, ticks in inputs:
        most = DRAW.felt + DRAW.rate_gain * norm(vehicle) + DRAW.error_gain * norm(error)
        most = min(most, DRAW.extra) + felt
        for _ in range(ticks):
            rate = draw.step(error, mean, felt, vehicle)
            assert norm(canals.feel(rate)) <= most * (1.0 + 1e-9) + 1e-8


def test_the_bound_is_reached() -> None:
    draw, canals = Draw(0.01, DRAW), Canals(0.01)
    felt = [norm(canals.feel(draw.step(ZERO, (1.0, 0.0, 0.0), 0.3, ZERO))) for _ in range(9)]
    assert felt == pytest.approx([0.3 + DRAW.felt] * 9, rel=1e-9)


def test_an_error_alone_is_felt_within_the_draw_s_own_bound() -> None:
    """What the members feel is for their mean: however much it is, an error does not use it."""
    draw, canals, error = Draw(0.01, DRAW), Canals(0.01), (0.0, 2.0, 0.0)
    felt = [norm(canals.feel(draw.step(error, ZERO, 5.0, ZERO))) for _ in range(50)]
    own = DRAW.felt + DRAW.error_gain * 2.0
    assert own < DRAW.response * 2.0, "or it would not be wished for"
    assert 0.9 * own < max(felt) <= own * (1.0 + 1e-9)


def test_within_its_bounds_it_turns_as_the_mean_does() -> None:
    draw = Draw(0.01, DRAW)
    for i in range(1000):
        mean = (0.05 * np.sin(0.01 * i), -0.02, 0.03 * np.cos(0.02 * i))
        assert draw.step(ZERO, mean, 0.1, ZERO) == pytest.approx(mean, abs=1e-12)


@given(vectors.filter(lambda v: norm(v) < 3.0))
def test_the_turn_brings_up_to_the_mean(turn: Vec3) -> None:
    mean = rotate(exp(turn), UP)
    brought = rotate(conjugate(exp(turn_to(mean, UP))), UP)
    assert angle_between(brought, mean) < 1e-6


def test_where_ups_cancel_there_is_no_turn() -> None:
    for size in (0.0, 1e-300, 1e-9, 0.0999):
        assert norm(turn_to((size, 0.0, 0.0), UP)) < 1e-12
    assert norm(turn_to((0.2, 0.0, 0.0), UP)) == pytest.approx(np.pi / 2.0)
    assert add(turn_to((0.0, 0.0, -1.0), UP), ZERO) == ZERO
