"""What share of an imagined motion would have been of use."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing.stage.adaptive_gain import AdaptiveGain

DT = 0.01


def after(
    demand: np.ndarray,
    imagined: np.ndarray,
    memory: float = 15.0,
    first: float = 0.2,
    doubt: float = 1e-6,
) -> float:
    useful = AdaptiveGain(DT, memory, first, doubt)
    for d, a in zip(demand.tolist(), imagined.tolist(), strict=True):
        useful.update(d, a)
    return useful.share


@pytest.mark.parametrize("memory", [2.0, 15.0])
def test_it_is_the_weighted_least_squares_of_demand_on_motion(memory: float) -> None:
    """Ticks weigh exp(-age / memory), and the first share counts as one more observation."""
    random = np.random.default_rng(3)
    a = random.standard_normal(2000)
    d = 0.3 * a + random.standard_normal(2000) + np.linspace(-1.0, 1.0, 2000)
    weight = np.exp(-np.arange(2000)[::-1] * DT / memory) * (1.0 - np.exp(-DT / memory))
    rows = np.append(np.sqrt(weight) * a, np.sqrt(0.05))
    aim = np.append(np.sqrt(weight) * d, np.sqrt(0.05) * 0.2)
    (expected,), *_ = np.linalg.lstsq(rows[:, None], aim)
    assert 0.05 < expected < 0.95
    assert after(d, a, memory, 0.2, 0.05) == pytest.approx(expected, rel=1e-9)


def test_motion_that_meets_the_demand_is_wanted_whole_and_motion_against_it_not_at_all() -> None:
    a = np.random.default_rng(1).standard_normal(3000)
    assert after(a, a) == pytest.approx(1.0, abs=1e-5)
    assert after(5.0 * a, a) == 1.0
    assert after(0.25 * a, a) == pytest.approx(0.25, abs=1e-5)
    assert after(-a, a) == 0.0
    assert after(np.roll(a, 1), a) < 0.1


def test_what_was_long_ago_is_forgotten() -> None:
    a = np.random.default_rng(1).standard_normal(8000)
    sign = np.where(np.arange(8000) < 4000, 1.0, -1.0)
    assert after(sign[:4000] * a[:4000], a[:4000], memory=5.0) > 0.99
    assert after(sign * a, a, memory=5.0) == 0.0


def test_it_begins_with_the_first_share_and_leaves_it_as_fast_as_the_doubt_allows() -> None:
    assert AdaptiveGain(DT, 15.0, 0.35, 1.0).share == 0.35
    a = np.full(50, 0.1)
    shares = [after(a, a, doubt=doubt) for doubt in (1e6, 1e-3, 1e-9)]
    assert shares[0] == pytest.approx(0.2, abs=1e-6)
    assert 0.2 < shares[0] < shares[1] < shares[2] <= 1.0
    assert shares[2] == pytest.approx(1.0, abs=1e-3)


@given(
    st.lists(st.tuples(st.floats(-1e6, 1e6), st.floats(-100.0, 100.0)), max_size=30),
    st.floats(0.0, 1.0),
)
def test_it_is_a_share_whatever_comes(pairs: list[tuple[float, float]], first: float) -> None:
    useful = AdaptiveGain(DT, 15.0, first, 0.01)
    for demand, imagined in pairs:
        useful.update(demand, imagined)
        assert 0.0 <= useful.share <= 1.0
