"""Figures do not depend on where a flight is cut, nor on how its columns lie in memory."""

import tracemalloc
from collections.abc import Callable
from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas_cueing.evaluation import Consistency, LimitUse, Metrics, RunColumns, gathered
from atlas_cueing.evaluation.run_columns import Figures
from atlas_cueing.signals import StageLimits, WheelLimits

from .flights import any_flight

TO_WHEELS = np.array([[7.0, -2.0, 1.0], [0.5, 6.0, -3.0], [-1.0, 2.0, 8.0]])
WHEELS = WheelLimits(
    speed=(10.0, 20.0, 30.0), acceleration=(6.0, 12.0, 18.0), jerk=(60.0, 120.0, 180.0)
)
STAGE = StageLimits(
    travel=(1.0, 1.0, 0.5),
    speed=(2.0, 1.0, 1.0),
    acceleration=(4.0, 5.0, 6.0),
    jerk=(40.0, 50.0, 60.0),
)
FIGURES: dict[str, Callable[[], Figures]] = {
    "metrics": Metrics,
    "limit_use": lambda: LimitUse(WHEELS, STAGE),
    "consistency": lambda: Consistency(TO_WHEELS, np.linalg.inv(TO_WHEELS)),
}
every = pytest.mark.parametrize("name", FIGURES)


def cut(figures: Figures, flight: RunColumns, cuts: list[int]) -> dict[str, float]:
    """Of a flight that comes in these pieces, none of them empty."""
    ends = sorted({min(end, len(flight.time)) for end in (*cuts, len(flight.time))})
    for start, end in zip([0, *ends], ends, strict=False):
        figures.add(flight.rows(slice(start, end)))
    return figures.figures()


@every
@settings(max_examples=25, deadline=None)
@given(st.integers(2, 600), st.lists(st.integers(2, 600), max_size=8), st.integers(0, 2**32 - 1))
def test_it_does_not_matter_where_a_flight_is_cut(
    name: str, count: int, cuts: list[int], seed: int
) -> None:
    """The first piece has two ticks, which tell the step.

    Quantiles are in single precision; angles have 1e-13 of rounding.
    """
    flight = any_flight(count, seed)
    whole, pieces = (cut(FIGURES[name](), flight, where) for where in ([], cuts))
    assert list(whole) == list(pieces)
    for figure, value in whole.items():
        rel = 1.2e-7 if "_p9" in figure else 1e-9
        assert pieces[figure] == pytest.approx(value, rel=rel, abs=1e-12), figure


@every
def test_a_long_flight_in_its_own_blocks(name: str) -> None:
    """Cut anywhere, against the blocks of `gathered`."""
    flight = any_flight(30_000, 5)
    whole = gathered(FIGURES[name](), flight)
    pieces = cut(FIGURES[name](), flight, [100, 9000, 9001, 9003, 23_456])
    for figure, value in whole.items():
        assert pieces[figure] == pytest.approx(
            value, rel=1.2e-7 if "_p9" in figure else 1e-9, abs=1e-12
        ), figure


@every
def test_a_figure_may_be_asked_for_on_the_way(name: str) -> None:
    """It changes nothing."""
    flight = any_flight(2000, 6)
    asked, plain = FIGURES[name](), FIGURES[name]()
    for start in range(0, 2000, 500):
        block = flight.rows(slice(start, start + 500))
        asked.add(block)
        assert asked.figures() == asked.figures()
        plain.add(block)
    assert asked.figures() == plain.figures()


@every
def test_rows_and_columns_give_the_same_to_the_last_bit(name: str) -> None:
    """A log read whole has its messages in rows, one read in blocks has them in columns."""
    flight = any_flight(20_000, 7)
    rows, columns = (
        RunColumns(**{field.name: order(getattr(flight, field.name)) for field in fields(flight)})
        for order in (in_rows, np.asfortranarray)
    )
    assert rows.felt_w.strides != columns.felt_w.strides
    assert gathered(FIGURES[name](), rows) == gathered(FIGURES[name](), columns)


def in_rows(values: np.ndarray) -> np.ndarray:
    """As a part of a table with more columns."""
    table = np.zeros((len(values), 9))
    width = values.shape[1] if values.ndim == 2 else 1
    table[:, 2 : 2 + width] = values.reshape(len(values), width)
    return table[:, 2 : 2 + width] if values.ndim == 2 else table[:, 2]


@every
def test_no_ticks_at_all(name: str) -> None:
    assert set(FIGURES[name]().figures().values()) == {0.0}


def test_what_is_held_grows_by_quantiles_only() -> None:
    """Eight columns in single precision, a mark a tick, and the slack of growing memory.

    Looked at after whole pieces of the correlations, which wait for 8192 - 2 * 50 ticks at 100 Hz:
    seven of these blocks.
    """
    flight = any_flight((8192 - 2 * 50) // 7, 8)
    figures = [make() for make in FIGURES.values()]
    held = []
    tracemalloc.start()
    try:
        for _ in range(28):
            for each in figures:
                each.add(flight)
            held.append(tracemalloc.get_traced_memory()[0])
    finally:
        tracemalloc.stop()
    assert held[27] - held[6] < 1.2 * (8 * 4 + 1) * 21 * len(flight.time)
