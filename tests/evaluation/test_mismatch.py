"""Mismatch in just noticeable differences: on flights of known errors, its legs, its worst 10 s."""

from dataclasses import replace
from math import radians, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.evaluation import RunColumns, gathered
from atlas_cueing.evaluation.mismatch import FORCE_JND, MOST, RATE_JND, Mismatch
from atlas_cueing.evaluation.statistics import WorstWindow
from atlas_cueing.perception.vestibular import CANALS

from .flights import G, any_flight, column, still

LEGS = ("mismatch_magnitude", "mismatch_direction", "mismatch_rate")
N = 4000


def figures(flight: RunColumns) -> dict[str, float]:
    return gathered(Mismatch(), flight)


def test_units_are_what_a_pilot_begins_to_notice() -> None:
    assert FORCE_JND == 0.17
    assert radians(3.0) == RATE_JND


def test_a_just_noticeable_error_of_force_all_the_way_is_one() -> None:
    found = figures(still(N, felt_f=np.array([0.0, 0.0, -G - 0.17])))
    assert found["mismatch"] == found["mismatch_magnitude"] == pytest.approx(1.0)
    assert found["mismatch_worst_10s"] == pytest.approx(1.0)
    assert found["mismatch_direction"] == found["mismatch_rate"] == 0.0


def test_an_error_of_direction_counts_by_the_size_of_the_force() -> None:
    """A chord of the circle with the force as its radius."""
    off = radians(10.0)
    tilted = np.array([0.0, np.sin(off), -np.cos(off)])
    for size in (0.1 * G, G, 4.0 * G):
        flight = still(N, vehicle_f_B=np.array([0.0, 0.0, -size]), felt_f=size * tilted)
        found = figures(flight)
        assert found["mismatch_direction"] == pytest.approx(2.0 * size * np.sin(off / 2.0) / 0.17)
        assert found["mismatch_magnitude"] == pytest.approx(0.0, abs=1e-12)


def test_a_small_angle_keeps_its_digits() -> None:
    felt = G * np.array([0.0, np.sin(1e-9), -np.cos(1e-9)])
    found = figures(still(N, felt_f=felt))
    assert found["mismatch_direction"] == pytest.approx(G * 1e-9 / 0.17, rel=1e-6)


def test_without_a_force_there_is_no_direction() -> None:
    found = figures(still(N, vehicle_f_B=np.zeros(3)))
    assert found["mismatch"] == found["mismatch_magnitude"] == pytest.approx(G / 0.17)
    assert found["mismatch_direction"] == 0.0


def test_a_rate_counts_as_the_canals_have_it() -> None:
    """A step that lasts is lost; a rate that was there from the start was never new."""
    rate = np.where(np.arange(N) < 5, 0.0, radians(3.0))
    found = figures(still(N, felt_w=column(rate, 1)))
    expected = np.sqrt(np.mean(CANALS.sense(rate, 0.01) ** 2)) / radians(3.0)
    assert found["mismatch"] == found["mismatch_rate"] == pytest.approx(expected)
    assert 0.2 < expected < 0.4
    assert found["mismatch_worst_10s"] > expected
    lasting = figures(still(N, felt_w=np.array([0.0, 0.3, 0.0])))
    assert lasting["mismatch_rate"] == pytest.approx(0.0, abs=1e-12)


def test_what_the_vehicle_does_itself_is_no_mismatch() -> None:
    flight = any_flight(N, 3)
    same = replace(flight, felt_f=flight.vehicle_f_B, felt_w=flight.vehicle_w_B)
    assert set(figures(same).values()) == {0.0}


@settings(max_examples=50)
@given(st.integers(0, 2**32 - 1), st.integers(1, 3000), st.floats(-6.0, 6.0))
def test_squares_of_the_legs_add_up(seed: int, count: int, magnitude: float) -> None:
    flight = any_flight(count, seed)
    flight = replace(flight, felt_f=10.0**magnitude * flight.felt_f)
    found = figures(flight)
    total = sum(found[leg] ** 2 for leg in LEGS)
    assert total == pytest.approx(found["mismatch"] ** 2, rel=1e-13)


def test_turning_the_cabin_never_changes_the_leg_of_magnitude() -> None:
    flight = any_flight(N, 4)
    turned = replace(flight, felt_f=flight.felt_f[:, [1, 2, 0]] * np.array([1.0, -1.0, -1.0]))
    one, other = figures(flight), figures(turned)
    assert one["mismatch_magnitude"] == pytest.approx(other["mismatch_magnitude"], rel=1e-12)
    assert one["mismatch_direction"] != pytest.approx(other["mismatch_direction"], rel=1e-3)


def test_the_worst_ten_seconds_are_wherever_they_are() -> None:
    """5 s of an error of 4 JND: the worst 10 s have it for half of their time."""
    for start in (0, 317, 2000, N - 500):
        force = still(N).felt_f
        force[start : start + 500, 2] -= 4.0 * 0.17
        found = figures(still(N, felt_f=force))
        assert found["mismatch"] == pytest.approx(4.0 * sqrt(500 / N))
        assert found["mismatch_worst_10s"] == pytest.approx(4.0 * sqrt(0.5))


def test_the_window_is_in_seconds() -> None:
    force = still(N).felt_f
    force[2000:2500, 2] -= 4.0 * 0.17
    fast = figures(still(N, 0.005, felt_f=force))
    assert fast["mismatch_worst_10s"] == pytest.approx(4.0 * sqrt(500 / 2000))


@pytest.mark.parametrize("count", [1, 2, 600, 1000])
def test_a_flight_shorter_than_the_window_is_the_window(count: int) -> None:
    found = figures(any_flight(count, 5))
    assert found["mismatch_worst_10s"] == pytest.approx(found["mismatch"], rel=1e-13)


@pytest.mark.parametrize("dt", [1e-320, 1e-9, 0.0, -1.0, np.nan, np.inf, 20.0, 1e300])
def test_any_time_of_a_damaged_log_has_a_window(dt: float) -> None:
    window = Mismatch()
    with np.errstate(all="ignore"):
        block = still(4, 0.01)
        window.add(replace(block, time=np.arange(4) * dt))
    assert set(window.figures()) == {"mismatch", *LEGS, "mismatch_worst_10s"}
    assert MOST * 8 < 2e6


@settings(max_examples=50)
@given(
    st.lists(st.floats(0.0, 1e3), max_size=80),
    st.integers(1, 90),
    st.lists(st.integers(0, 80), max_size=5).map(sorted),
)
def test_largest_mean_in_pieces(values: list[float], ticks: int, cuts: list[int]) -> None:
    x = np.array(values)
    window = WorstWindow(ticks)
    for piece in np.split(x, cuts):
        window.add(piece)
    every = [x[k : k + ticks] for k in range(max(len(x) - ticks, 0) + 1)] if len(x) else []
    expected = max((float(np.mean(part)) for part in every), default=0.0)
    assert window.mean == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_an_infinite_value_makes_the_worst_infinite() -> None:
    window = WorstWindow(3)
    for piece in ([1.0, np.inf, 2.0, 0.0], [1.0, 1.0, 1.0, 1.0]):
        window.add(np.array(piece))
    assert window.mean == np.inf
