"""Cues of every kind, made by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from atlas_cueing.evaluation.cues import (
    FORCE_THRESHOLD,
    GAIN_BAND,
    RATE_THRESHOLD,
    CueCounter,
)

T = 0.17
LOW, HIGH = GAIN_BAND
NONE, MISSING, FALSE, SCALED = (
    {"missing": float(kind == 0), "false": float(kind == 1), "scaled": float(kind == 2)}
    for kind in (-1, 0, 1, 2)
)


def cue_shares(vehicle: np.ndarray, platform: np.ndarray, threshold: float) -> dict[str, float]:
    cues = CueCounter(threshold)
    cues.add(vehicle, platform)
    return cues.shares()


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("vehicle", "platform", "kind"),
    [
        (0.0, 0.0, NONE),
        (0.9 * T, -0.9 * T, NONE),  # nobody notices either
        (T, T, NONE),
        (2.0, 2.0, NONE),
        (2.0, 2.0 * LOW * 1.001, NONE),
        (2.0, 2.0 * HIGH * 0.999, NONE),
        (2.0, 2.0 * LOW * 0.999, SCALED),
        (2.0, 2.0 * HIGH * 1.001, SCALED),
        (2.0, 1.01 * T, SCALED),
        (2.0, T, MISSING),
        (2.0, 0.0, MISSING),
        (2.0, -0.9 * T, MISSING),
        (1.01 * T, 0.99 * T, MISSING),
        (0.0, 2.0, FALSE),
        (0.99 * T, 1.01 * T, FALSE),
        (2.0, -2.0, FALSE),
        (2.0, -1.01 * T, FALSE),
        (-0.9 * T, 2.0, FALSE),
    ],
)
def test_one_tick_of_each_kind(
    vehicle: float, platform: float, sign: float, kind: dict[str, float]
) -> None:
    assert cue_shares(np.array([sign * vehicle]), np.array([sign * platform]), T) == kind


def test_shares_of_a_flight() -> None:
    """1000 ticks: 100 missing, 200 false (half of them reversed), 50 scaled, the rest right."""
    vehicle, platform = np.zeros(1000), np.zeros(1000)
    vehicle[:100] = 1.0
    platform[200:300] = -1.0
    vehicle[300:400], platform[300:400] = 1.0, -1.0
    vehicle[500:550], platform[500:550] = -1.0, -0.5
    vehicle[600:], platform[600:] = 1.0, 0.9
    assert cue_shares(vehicle, platform, T) == {"missing": 0.1, "false": 0.2, "scaled": 0.05}


def test_a_sine_of_half_the_size() -> None:
    """Above the threshold it is scaled, or missing where its half is below: arcs of a sine."""
    phase = np.arange(100_000) * 2.0 * np.pi / 100_000
    shares = cue_shares(np.sin(phase), 0.5 * np.sin(phase), 0.2)
    above, half_above = (1.0 - 2.0 / np.pi * np.arcsin(x) for x in (0.2, 0.4))
    assert shares["scaled"] == pytest.approx(half_above, abs=1e-4)
    assert shares["missing"] == pytest.approx(above - half_above, abs=1e-4)
    assert shares["false"] == 0.0


signals = arrays(np.float64, (2, 30), elements=st.floats(-1.0, 1.0))


@given(signals, st.floats(0.01, 0.5))
def test_no_tick_is_of_two_kinds_and_signs_do_not_matter(
    pair: np.ndarray, threshold: float
) -> None:
    vehicle, platform = pair
    shares = cue_shares(vehicle, platform, threshold)
    assert sum(shares.values()) <= 1.0 + 1e-12
    assert cue_shares(-vehicle, -platform, threshold) == shares
    assert cue_shares(vehicle, vehicle, threshold) == NONE


@given(signals, st.floats(0.01, 0.5))
def test_exchanging_vehicle_and_platform(pair: np.ndarray, threshold: float) -> None:
    """What is missing one way is false the other way; reversed cues are false both ways.

    The band is its own reciprocal.
    """
    vehicle, platform = pair
    forth, back = cue_shares(vehicle, platform, threshold), cue_shares(platform, vehicle, threshold)
    assert forth["missing"] + forth["false"] == pytest.approx(
        np.mean(_wrong(vehicle, platform, threshold))
    )
    assert back["missing"] + back["false"] == pytest.approx(forth["missing"] + forth["false"])
    assert back["scaled"] == pytest.approx(forth["scaled"])


def _wrong(vehicle: np.ndarray, platform: np.ndarray, threshold: float) -> list[bool]:
    """By the signs alone: -1, 0 and 1 below, within and above the threshold."""
    return [
        _sign(a, threshold) != _sign(b, threshold) for a, b in zip(vehicle, platform, strict=True)
    ]


def _sign(x: float, threshold: float) -> int:
    return int(x > threshold) - int(x < -threshold)


@given(signals, st.lists(st.integers(0, 30), max_size=4).map(sorted))
def test_counted_in_pieces(pair: np.ndarray, cuts: list[int]) -> None:
    cues = CueCounter(T)
    for vehicle, platform in zip(*(np.split(signal, cuts) for signal in pair), strict=True):
        cues.add(vehicle, platform)
    assert cues.shares() == cue_shares(*pair, T)


def test_no_ticks() -> None:
    assert cue_shares(np.empty(0), np.empty(0), T) == NONE


def test_thresholds_of_the_literature() -> None:
    assert FORCE_THRESHOLD == (0.17, 0.17, 0.28)
    assert np.degrees(RATE_THRESHOLD).tolist() == pytest.approx([3.0, 3.6, 2.6])
