"""The account a live run gives of its own punctuality."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.recording import TopicColumns
from atlas_cueing.review import RecordedRun
from atlas_cueing.review.checks.deadlines import check_deadlines, is_live, punctuality_notes
from atlas_cueing.signals import TIMING

from ..runs import coning

MISSED_AT, MISSED = 200, 3


def live(**columns: np.ndarray) -> RecordedRun:
    """A run that missed three deadlines at its tick 200, with some columns of /timing replaced."""
    run = coning()
    count, dt = len(run.flight.time), 0.01
    at = np.arange(count)
    table = {
        "time_s": run.flight.time,
        "elapsed_s": run.flight.time + dt * MISSED * (at > MISSED_AT),
        "lateness_s": np.where(at == MISSED_AT, 3.5 * dt, 2e-5),
        "cost_s": np.full(count, 1e-4),
        "input_age_s": np.zeros(count),
        "missed_deadlines": MISSED * (at >= MISSED_AT).astype(float),
        "wheel_difference_rad": np.zeros(len(at)),
        "stage_difference_m": np.zeros(len(at)),
        "state": np.full(count, 2.0),
    } | columns
    values = np.column_stack([table[name] for name in TIMING.fields])
    return replace(
        run,
        log=replace(
            run.log, tables={**run.log.tables, TIMING.name: TopicColumns(TIMING.fields, values)}
        ),
    )


def test_a_run_without_timing_is_not_live() -> None:
    assert not is_live(coning())
    assert check_deadlines(coning()) == []
    assert punctuality_notes(coning()) == []


def test_an_honest_account() -> None:
    assert is_live(live())
    assert check_deadlines(live()) == []


@pytest.mark.parametrize("count", [0, 2, 4])
def test_a_wrong_number_of_missed_deadlines(count: int) -> None:
    at = np.arange(601)
    (found,) = check_deadlines(live(missed_deadlines=count * (at >= MISSED_AT).astype(float)))
    assert found.check == "real time does not fit the missed deadlines"
    assert found.time == pytest.approx(0.01 * (MISSED_AT + 1))


def test_a_clock_that_slips_by_ten_microseconds() -> None:
    at = np.arange(601)
    (found,) = check_deadlines(
        live(elapsed_s=0.01 * (at + MISSED * (at > MISSED_AT)) + 1e-5 * (at > 400))
    )
    assert found.time == pytest.approx(4.01)
    assert "difference = 1" in found.text


def test_a_tick_before_its_deadline() -> None:
    late = np.full(601, 1e-5)
    late[77] = -1e-5
    (found,) = check_deadlines(live(lateness_s=late))
    assert (found.check, found.time) == ("a tick began early", pytest.approx(0.77))


def test_notes() -> None:
    notes = punctuality_notes(live())
    assert notes[0] == "3 deadlines missed"
    assert notes[1] == "lateness p50 20, p99 20, p99.9 35000, max 35000 us"
    assert notes[2] == "tick cost p50 100, p99 100, p99.9 100, max 100 us"
    assert len(punctuality_notes(live(missed_deadlines=np.zeros(601)))) == 2
