"""Time on a run known in closed form."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.review.checks.timestamps import UNEVEN, check_timestamps

from ..runs import coning, with_flight


@pytest.mark.parametrize("dt", [0.0083333, 1.0 / 120.0, 0.001, 0.1])
@pytest.mark.parametrize("start", [0.0, 3600.0])
def test_even_time_is_clean_after_an_hour_too(dt: float, start: float) -> None:
    run = coning(500, dt)
    assert (
        check_timestamps(with_flight(run, replace(run.flight, time=start + run.flight.time))) == []
    )


def test_each_topic_has_its_own_clock() -> None:
    run = coning()
    table = run.log.tables["/felt"]
    values = table.values.copy()
    values[50, 0] += 1e-12
    bad = replace(
        run, log=replace(run.log, tables={**run.log.tables, "/felt": replace(table, values=values)})
    )
    (found,) = check_timestamps(bad)
    assert (found.check, found.place) == ("time differs from /motion", "/felt time_s")


@pytest.mark.parametrize(
    ("shift", "checks"), [(0.5 * UNEVEN, []), (3.0 * UNEVEN, ["uneven time"]), (0.9, ["gap"])]
)
def test_how_uneven_is_too_uneven(shift: float, checks: list[str]) -> None:
    run = coning()
    time = run.flight.time.copy()
    time[300] += shift * 0.01
    found = check_timestamps(with_flight(run, replace(run.flight, time=time)))
    assert [finding.check for finding in found][: len(checks)] == checks
    assert bool(found) == bool(checks)


def test_messages_lost_in_the_middle_and_at_the_end() -> None:
    run = coning()
    for keep, when in ((np.delete(np.arange(601), 200), 2.0), (np.arange(600), 6.0)):
        table = run.log.tables["/wheels"]
        tables = {**run.log.tables, "/wheels": replace(table, values=table.values[keep])}
        (found,) = check_timestamps(replace(run, log=replace(run.log, tables=tables)))
        assert (found.check, found.place) == ("ticks lost", "/wheels")
        assert found.time == pytest.approx(when)


@pytest.mark.parametrize("rate", [-1.0, 0.0])
def test_time_that_runs_back_or_stands_still_throughout(rate: float) -> None:
    run = coning()
    (found,) = check_timestamps(
        with_flight(run, replace(run.flight, time=1.0 + rate * run.flight.time))
    )
    assert (found.check, found.place) == ("time runs back", "/motion time_s")
    assert (
        found.text == f"step = {-0.01 if rate else 0} s, allowed: step > 0 (the worst of 600 steps)"
    )


def test_one_step_back() -> None:
    run = coning()
    time = run.flight.time.copy()
    time[[300, 301]] = time[[301, 300]]
    found = check_timestamps(with_flight(run, replace(run.flight, time=time)))
    assert (found[0].check, found[0].time) == ("time runs back", pytest.approx(3.0))
    assert found[0].text == "step = -0.01 s, allowed: step > 0"


@pytest.mark.parametrize("count", [0, 1, 2])
def test_few_ticks(count: int) -> None:
    assert check_timestamps(coning(count)) == []
