"""Times that differ from k dt by rounding are no finding; times that differ by more are."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.review import cue_again, review_log
from atlas_cueing.review.checks.rounding import COARSEST, rounding

from ..corrupting import Columns, corrupted

Rounded = Callable[[np.ndarray], np.ndarray]
STEP = 1.0 / 120.0
ROUNDINGS: dict[str, Rounded] = {
    "sums of steps": lambda time: np.cumsum(np.full(len(time), STEP)) - STEP,
    "whole ns": lambda time: np.rint(time * 1e9) / 1e9,
    "whole us": lambda time: np.round(time, 6),
    "cut to us": lambda time: np.floor(time * 1e6) / 1e6,
    "seconds since 1970": lambda time: (time + 1.8e9) - 1.8e9,
}


def times(rounded: Rounded, topic: str) -> Callable[[Columns], None]:
    def change(columns: Columns) -> None:
        for name in columns:
            if name.endswith(" time_s") and name.startswith(topic):
                columns[name][:] = rounded(columns[name])

    return change


@pytest.mark.parametrize("topic", ["", "/cue", "/motion"], ids=["all", "cue", "motion"])
@pytest.mark.parametrize("name", ROUNDINGS)
def test_rounded_times_are_clean(flight: Path, tmp_path: Path, name: str, topic: str) -> None:
    found = review_log(corrupted(flight, tmp_path / "x.mcap", times(ROUNDINGS[name], topic)))
    assert found.findings == ()


@pytest.mark.parametrize("name", ["whole us", "seconds since 1970"])
def test_a_flight_with_rounded_times_is_cued_anew(flight: Path, tmp_path: Path, name: str) -> None:
    """Its step is that of the whole flight: the first one is off by a hundredth of a us."""
    corrupted(flight, tmp_path / "x.mcap", times(ROUNDINGS[name], ""))
    cue_again(tmp_path / "x.mcap", [], tmp_path / "again.mcap")
    assert review_log(tmp_path / "again.mcap").findings == ()


@pytest.mark.parametrize(
    ("rounded", "check"),
    [
        (lambda time: np.round(time, 3), "time differs from /motion"),
        (lambda time: time + 2e-6, "time differs from /motion"),
        (
            lambda time: np.where(np.arange(len(time)) == 300, time + 1e-9, time),
            "time differs from /motion",
        ),
    ],
    ids=["ms", "late", "one tick"],
)
def test_what_is_no_rounding_is_found(
    flight: Path, tmp_path: Path, rounded: Rounded, check: str
) -> None:
    found = review_log(corrupted(flight, tmp_path / "x.mcap", times(rounded, "/cue")))
    assert (check, "/cue time_s") in {(finding.check, finding.place) for finding in found.findings}


def test_the_bound() -> None:
    even = STEP * np.arange(1000)
    assert np.all(rounding(even) <= np.arange(1000) * np.spacing(even) + 5e-15)
    quantised = rounding(np.round(even, 6))
    assert 5e-7 < quantised.max() <= COARSEST + 1e-11
    odd = even.copy()
    odd[500] += 1e-3
    assert rounding(odd).max() < 1e-11
    assert rounding(np.array([])).shape == (0,)
    assert rounding(np.array([3.0])).tolist() == [0.0]
    assert np.all(rounding(np.array([0.0, np.nan, 2.0])) <= COARSEST + 1e-11)
