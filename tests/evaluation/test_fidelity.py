"""Figures of each axis: which signals, which threshold, which organ."""

import numpy as np
import pytest

from atlas_cueing.evaluation import gathered
from atlas_cueing.evaluation.cues import FORCE_THRESHOLD, RATE_THRESHOLD
from atlas_cueing.evaluation.fidelity import LEVEL, VARIATION, Fidelity
from atlas_cueing.perception.vestibular import CANALS, OTOLITHS

from .flights import column, still

N, DT = 8000, 0.01
T = np.arange(N) * DT
W = 2.0  # rad/s
SIDES = {"force": ("vehicle_f_B", "felt_f"), "rate": ("vehicle_w_B", "felt_w")}
ORGANS = {"force": OTOLITHS, "rate": CANALS}
THRESHOLDS = {"force": FORCE_THRESHOLD, "rate": RATE_THRESHOLD}
each = pytest.mark.parametrize(
    ("name", "axis"), [(name, axis) for name in SIDES for axis in range(3)]
)


def pair(name: str, axis: int, pilot: np.ndarray, rider: np.ndarray) -> dict[str, float]:
    """Figures of a flight with these departures from rest along one axis."""
    rest = {"force": still(N).felt_f, "rate": still(N).felt_w}[name]
    changes = {
        side: rest + column(signal, axis)
        for side, signal in zip(SIDES[name], (pilot, rider), strict=True)
    }
    return gathered(Fidelity(), still(N, DT, **changes))


@each
def test_a_late_and_smaller_sine(name: str, axis: int) -> None:
    """Its delay is the same through the organ, which turns the phase of both alike."""
    figures = pair(name, axis, np.sin(W * T), 0.5 * np.sin(W * (T - 0.123)))
    for prefix in ("", "perceived_"):
        start = f"{prefix}{name}_{'xyz'[axis]}"
        assert figures[f"{start}_delay_s"] == pytest.approx(0.123, abs=1e-4 if not prefix else 5e-3)
        assert figures[f"{start}_correlation"] == pytest.approx(
            1.0, abs=1e-4 if not prefix else 0.02
        )
        assert figures[f"{start}_scaled_share"] > 0.5
    own = f"{name}_{'xyz'[axis]}_"
    assert {
        v for k, v in figures.items() if k.endswith(("_share", "_correlation")) and own not in k
    } == {0.0}


@each
def test_a_platform_that_stands_still_misses_the_cue(name: str, axis: int) -> None:
    """The share is the sine's arc above the axis' own threshold.

    The cue would be false the other way round.
    """
    threshold = THRESHOLDS[name][axis]
    amplitude = 2.0 * threshold
    start = f"{name}_{'xyz'[axis]}"
    missing = pair(name, axis, amplitude * np.sin(W * T), np.zeros(N))
    false = pair(name, axis, np.zeros(N), amplitude * np.sin(W * T))
    arc = 1.0 - 2.0 / np.pi * np.arcsin(0.5)
    assert missing[f"{start}_missing_share"] == pytest.approx(arc, abs=0.01)
    assert false[f"{start}_false_share"] == pytest.approx(arc, abs=0.01)
    assert missing[f"{start}_correlation"] == missing[f"{start}_delay_s"] == 0.0
    # The organ passes on a part of it, and of the threshold nearly the same part.
    passed = np.abs(ORGANS[name].response([W, LEVEL]))
    perceived = passed[0] / passed[1]
    arc = 1.0 - 2.0 / np.pi * np.arcsin(0.5 / perceived)
    assert missing[f"perceived_{start}_missing_share"] == pytest.approx(arc, abs=0.03)


@each
def test_perceived_error_has_the_organs_gain(name: str, axis: int) -> None:
    figures = pair(name, axis, 0.3 * np.cos(W * T), 0.3 * np.cos(W * T) + 0.2 * np.sin(W * T))
    unit = {"force": "m_s2", "rate": "rad_s"}[name]
    amplitude = 0.2 * np.abs(ORGANS[name].response(W))
    assert figures[f"perceived_{name}_rms_{unit}"] == pytest.approx(
        amplitude / np.sqrt(2.0), rel=0.03
    )
    assert figures[f"perceived_{name}_max_{unit}"] == pytest.approx(amplitude, rel=0.15)
    other = {"force": "rate_rms_rad_s", "rate": "force_rms_m_s2"}[name]
    assert figures[f"perceived_{other}"] == 0.0


def test_perceived_error_is_what_the_organ_makes_of_the_error() -> None:
    """The models are linear, so the difference can go through them in place of both sides."""
    random = np.random.default_rng(2)
    f, g, v, w = np.cumsum(random.normal(size=(4, N, 3)), axis=1) * 0.02
    figures = gathered(Fidelity(), still(N, DT, vehicle_f_B=f, felt_f=g, vehicle_w_B=v, felt_w=w))
    for name, unit, error in (("force", "m_s2", g - f), ("rate", "rad_s", w - v)):
        sensed = np.column_stack([ORGANS[name].sense(error[:, i], DT) for i in range(3)])
        size = np.linalg.norm(sensed, axis=1)
        assert figures[f"perceived_{name}_rms_{unit}"] == pytest.approx(
            np.sqrt(np.mean(size**2)), rel=1e-9
        )
        assert figures[f"perceived_{name}_p95_{unit}"] == pytest.approx(
            np.quantile(size, 0.95), rel=1e-7
        )
        assert figures[f"perceived_{name}_max_{unit}"] == pytest.approx(np.max(size), rel=1e-9)


def test_weight_is_no_cue() -> None:
    assert set(gathered(Fidelity(), still(N, DT)).values()) == {0.0}


def test_a_cabin_upside_down_is_a_false_cue_about_heave() -> None:
    figures = gathered(Fidelity(), still(N, DT, felt_f=-still(N).felt_f))
    assert figures["force_z_false_share"] == figures["perceived_force_z_false_share"] == 1.0
    assert figures["force_x_false_share"] == 0.0
    assert figures["perceived_force_rms_m_s2"] == pytest.approx(0.4 * 2.0 * 9.80665)


@each
def test_variation_far_below_the_threshold_is_none(name: str, axis: int) -> None:
    smallest = VARIATION * THRESHOLDS[name][axis] * np.sqrt(2.0)
    start = f"{name}_{'xyz'[axis]}_correlation"
    assert pair(name, axis, 0.99 * smallest * np.sin(W * T), np.sin(W * T))[start] == 0.0
    assert pair(name, axis, 1.02 * smallest * np.sin(W * T), np.sin(W * T))[start] == pytest.approx(
        1.0
    )


def test_delay_is_in_seconds_of_the_flights_own_time() -> None:
    """The same ticks, twice as fast."""
    signals = (column(np.sin(W * T), 1), column(np.sin(W * (T - 0.2)), 1))
    slow, fast = (
        gathered(Fidelity(), still(N, dt, vehicle_w_B=signals[0], felt_w=signals[1]))
        for dt in (DT, 0.5 * DT)
    )
    assert slow["rate_y_delay_s"] == pytest.approx(0.2, abs=1e-4)
    assert fast["rate_y_delay_s"] == pytest.approx(0.1, abs=1e-4)
