"""What a finding says."""

import numpy as np
import pytest

from atlas_cueing.review.finding import Finding, exceeding

TIME = np.arange(5) * 0.1


def test_the_worst_is_told_with_time_and_place() -> None:
    values = np.array([[0.0, 0.0], [1.5, 0.0], [-3.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    (found,) = exceeding("limit", ["a", "b"], TIME, values, [1.0, 1.0], "m")
    assert (found.check, found.place, found.time) == ("limit", "a", pytest.approx(0.2))
    assert (
        str(found)
        == "0.200000 s a: limit: |value| = 3 m, allowed: |value| <= 1 m (the worst of 3 ticks, the"
        " first at 0.100000 s)"
    )
    assert found.to_json() == {
        "check": "limit",
        "place": "a",
        "time_s": found.time,
        "text": found.text,
    }


def test_a_single_column_and_bounds_of_each_tick() -> None:
    values = np.array([1.0, 1.0, 1.0, 1.0, 5.0])
    (found,) = exceeding(
        "gap",
        ["t"],
        TIME,
        values,
        np.array([[2.0], [0.9], [2.0], [0.5], [4.9]]),
        "s",
        quantity="step",
    )
    assert found.time == pytest.approx(0.3)  # twice what is allowed there, though not the largest
    assert "step = 1 s, allowed: step <= 0.5 s (the worst of 3 ticks" in found.text


def test_resting_on_a_bound_is_fair_and_nan_is_not_judged() -> None:
    assert exceeding("limit", ["a"], TIME, np.array([1.0, -1.0, np.nan, 0.0, 0.0]), 1.0, "m") == []
    assert exceeding("limit", ["a"], TIME[:0], np.empty((0, 1)), 1.0, "m") == []
    assert len(exceeding("limit", ["a"], TIME, np.array([np.inf, 0, 0, 0, 0]), 1.0, "m")) == 1
    assert len(exceeding("zero", ["a"], TIME, np.array([1e-300, 0, 0, 0, 0]), 0.0, "m")) == 1


def test_a_finding_of_the_whole_log() -> None:
    assert str(Finding("result", "atlas.run", None, "no")) == "atlas.run: result: no"


def test_a_quantity_without_unit_ends_in_its_number() -> None:
    (found,) = exceeding("norm", ["q"], np.array([0.0]), np.array([2.0]), 1.0, "")
    assert found.text == "|value| = 2, allowed: |value| <= 1"
