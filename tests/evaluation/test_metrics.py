"""The one list of figures: complete, ordered, with units, and always numbers."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.evaluation import Metrics, gathered

from .flights import still

N = 1000
PAIRS = (
    "vehicle_f_B",
    "felt_f",
    "vehicle_w_B",
    "felt_w",
    "motion_w_W",
    "motion_a_W",
    "wheel_speed",
)


def test_a_perfect_flight_has_no_errors() -> None:
    figures = gathered(Metrics(), still(N))
    assert figures.pop("ticks") == N
    assert figures.pop("duration_s") == pytest.approx(9.99)
    assert figures.pop("direction_counted_share") == 1.0
    assert set(figures.values()) == {0.0}


@pytest.mark.parametrize("count", [0, 1, 2, 3, 5])
def test_very_short_flights_have_figures_too(count: int) -> None:
    noise = np.random.default_rng(count).normal(size=(count, 3))
    figures = gathered(Metrics(), still(count, **dict.fromkeys(PAIRS, noise)))
    assert figures["ticks"] == count
    assert all(np.isfinite(value) for value in figures.values())


def test_the_most_important_come_first() -> None:
    names = list(gathered(Metrics(), still(3)))
    for first, then in [
        ("mismatch", "force_rms_m_s2"),
        ("force_rms_m_s2", "direction_rms_rad"),
        ("direction_max_rad", "rate_rms_rad_s"),
        ("rate_max_rad_s", "attitude_rms_rad"),
        ("attitude_max_rad", "extra_rate_p99_rad_s"),
        ("extra_rate_max_rad_s", "perceived_force_rms_m_s2"),
        ("perceived_rate_max_rad_s", "force_x_correlation"),
        ("rate_z_scaled_share", "perceived_force_x_correlation"),
        ("perceived_rate_z_scaled_share", "perceived_tilt_rms_rad"),
        ("perceived_turn_rms_rad_s", "coriolis_rms_rad_s2"),
        ("coriolis_rms_rad_s2", "turns_roll"),
        ("turns_yaw", "cue_lag_rms_rad"),
    ]:
        assert names.index(first) < names.index(then), (first, then)


def test_every_axis_has_the_same_figures() -> None:
    names = set(gathered(Metrics(), still(3)))
    kinds = {"correlation", "delay_s", "missing_share", "false_share", "scaled_share"}
    for prefix in ("force", "rate", "perceived_force", "perceived_rate"):
        for axis in "xyz":
            start = f"{prefix}_{axis}_"
            assert {name.removeprefix(start) for name in names if name.startswith(start)} == kinds


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(1, 60), st.floats(-3.0, 3.0))
def test_figures_are_finite_and_shares_are_shares(seed: int, count: int, magnitude: float) -> None:
    random = np.random.default_rng(seed)
    changes = {name: 10.0**magnitude * random.normal(size=(count, 3)) for name in PAIRS}
    figures = gathered(
        Metrics(), still(count, limited=random.integers(0, 2, (count, 2)).astype(float), **changes)
    )
    json.dumps(figures, allow_nan=False)
    assert {type(value) for value in figures.values()} == {float}
    for name, value in figures.items():
        if name.endswith("_share"):
            assert 0.0 <= value <= 1.0, name
        elif name.endswith("_correlation"):
            assert -1.0 <= value <= 1.0, name
        elif not name.endswith("_delay_s") and not name.startswith("turns_"):
            assert value >= 0.0, name


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(5, 60))
def test_rms_p95_and_max_are_in_order(seed: int, count: int) -> None:
    random = np.random.default_rng(seed)
    changes = {name: random.normal(size=(count, 3)) for name in PAIRS}
    figures = gathered(Metrics(), still(count, **changes))
    units = {
        "force": "m_s2",
        "direction": "rad",
        "rate": "rad_s",
        "perceived_force": "m_s2",
        "perceived_rate": "rad_s",
    }
    for name, unit in units.items():
        rms, p95, largest = (figures[f"{name}_{kind}_{unit}"] for kind in ("rms", "p95", "max"))
        assert 0.0 < rms <= largest, name
        assert 0.0 < p95 <= largest, name


def test_a_longer_flight_of_the_same_has_the_same_figures() -> None:
    """Longer than the pieces that are computed at a time."""
    motion = np.random.default_rng(1).normal(size=(10_000, 3))
    once, twice = (
        gathered(
            Metrics(),
            still(10_000 * k, vehicle_f_B=np.tile(motion, (k, 1)), felt_w=np.tile(motion, (k, 1))),
        )
        for k in (1, 2)
    )
    for name in (
        "force_rms_m_s2",
        "force_max_m_s2",
        "rate_rms_rad_s",
        "rate_max_rad_s",
        "coriolis_rms_rad_s2",
    ):
        assert twice[name] == pytest.approx(once[name], rel=1e-12)
    assert twice["force_x_missing_share"] == once["force_x_missing_share"] > 0.5
