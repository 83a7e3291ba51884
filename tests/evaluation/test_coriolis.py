"""Net turns and cross-coupling of turns that are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from atlas_cueing.evaluation import gathered
from atlas_cueing.evaluation.coriolis import NOD, Coriolis

from .flights import column, sine, still

rates = st.tuples(*[st.floats(-3.0, 3.0)] * 3).map(np.array)


def test_turns_are_net_and_about_the_cabins_axes() -> None:
    time = np.arange(1001) * 0.01
    roll = 2.0 * np.pi * 3.5 / 10.0 * np.ones(1001)
    felt_w = np.column_stack([roll, -0.5 * roll, np.sin(2.0 * np.pi * time / 10.0)])
    figures = gathered(Coriolis(), still(1001, felt_w=felt_w))
    assert figures["turns_roll"] == pytest.approx(3.5)
    assert figures["turns_pitch"] == pytest.approx(-1.75)
    assert figures["turns_yaw"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("axis", "share"), [(0, 1.0), (1, 0.0), (2, 1.0)])
@pytest.mark.parametrize(
    ("field", "name"), [("felt_w", "coriolis"), ("vehicle_w_B", "vehicle_coriolis")]
)
def test_nodding_couples_with_roll_and_yaw_only(
    axis: int, share: float, field: str, name: str
) -> None:
    figures = gathered(Coriolis(), still(1000, **{field: column(sine(1000, 0.5, 4), axis)}))
    assert figures[f"{name}_rms_rad_s2"] == pytest.approx(share * NOD * 0.5 / np.sqrt(2.0))
    assert figures[f"{name}_p95_rad_s2"] == pytest.approx(
        share * NOD * 0.5 * np.sin(0.95 * np.pi / 2.0), rel=1e-3
    )
    other = {"coriolis": "vehicle_coriolis", "vehicle_coriolis": "coriolis"}[name]
    assert figures[f"{other}_rms_rad_s2"] == 0.0


@given(rates)
def test_against_the_rate_of_a_nodding_head(w: np.ndarray) -> None:
    """The cabin's steady rate in the axes of a head that nods, differenced in time."""
    h = 1e-4
    seen = [Rotation.from_rotvec([0.0, NOD * t, 0.0]).inv().apply(w) for t in (-h, h)]
    figures = gathered(Coriolis(), still(10, felt_w=w))
    assert figures["coriolis_rms_rad_s2"] == pytest.approx(
        np.linalg.norm(seen[1] - seen[0]) / (2.0 * h), abs=1e-6
    )
    assert figures["coriolis_p95_rad_s2"] == pytest.approx(
        figures["coriolis_rms_rad_s2"], rel=1e-7, abs=1e-12
    )


def test_turns_of_uneven_ticks_in_blocks() -> None:
    """The time between two blocks counts as well: the trapezoids of the whole, by numpy."""
    random = np.random.default_rng(2)
    time, w = np.cumsum(random.uniform(0.005, 0.015, 20_000)), random.normal(0.1, 1.0, (20_000, 3))
    figures = gathered(Coriolis(), still(20_000, time=time, felt_w=w))
    expected = np.trapezoid(w, time, axis=0) / (2.0 * np.pi)
    assert [figures[f"turns_{name}"] for name in ("roll", "pitch", "yaw")] == pytest.approx(
        expected.tolist(), rel=1e-11
    )


def test_no_ticks() -> None:
    assert set(gathered(Coriolis(), still(0)).values()) == {0.0}
