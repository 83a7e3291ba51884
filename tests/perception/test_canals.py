"""The canals tick by tick, against the same organ for whole signals."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.perception import CANALS, OTOLITHS, Canals, Organ, Sensing


@pytest.mark.parametrize("organ", [CANALS, OTOLITHS], ids=["canals", "otoliths"])
@given(seed=st.integers(0, 99), dt=st.sampled_from([1e-3, 1.0 / 120.0, 0.5]))
def test_tick_by_tick_it_senses_what_the_whole_signal_gives(
    organ: Organ, seed: int, dt: float
) -> None:
    signal = np.cumsum(np.random.default_rng(seed).normal(size=(70, 3)), axis=0)
    canals = Canals(dt, tuple(signal[0]), organ)
    sensed = np.array([canals.sense(tuple(row)) for row in signal])
    whole = np.stack([Sensing(organ, dt).sense(signal[:, i]) for i in range(3)], axis=1)
    np.testing.assert_allclose(sensed, whole, rtol=0, atol=1e-12 * np.max(np.abs(signal)))


def test_a_lasting_rate_is_not_felt() -> None:
    canals = Canals(0.01, (1.0, -2.0, 3.0))
    for _ in range(100):
        assert canals.sense((1.0, -2.0, 3.0)) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
