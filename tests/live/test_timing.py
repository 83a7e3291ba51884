"""Percentiles to the microsecond, against numpy's."""

from dataclasses import replace

import numpy as np
import pytest

from atlas_cueing.live.session import _unsent
from atlas_cueing.live.timing import Histogram, LoopTiming

from .commands import REST


def test_percentiles_are_those_of_the_durations() -> None:
    durations = np.random.default_rng(1).exponential(2e-4, 5000)
    histogram = Histogram()
    for duration in durations.tolist():
        histogram.add(duration)
    assert histogram.count == 5000
    assert histogram.maximum == durations.max()
    for share in (0.01, 0.5, 0.99, 0.999, 1.0):
        exact = float(np.quantile(durations, share, method="inverted_cdf"))
        assert exact <= histogram.percentile(share) <= exact + 1e-6
    assert sum(histogram.counts()) == 5000


def test_none_one_and_odd_ones() -> None:
    histogram = Histogram()
    assert (histogram.percentile(0.5), histogram.maximum) == (0.0, 0.0)
    histogram.add(3.2e-5)
    assert histogram.percentile(0.5) == histogram.percentile(0.999) == 3.2e-5
    histogram.add(-1e-9)  # a clock may wake a nanosecond early
    histogram.add(7.0)
    assert histogram.maximum == 7.0
    assert histogram.counts()[0] == 1
    assert histogram.counts()[-1] == 1
    assert histogram.percentile(0.01) == 1e-6


def test_figures_have_their_units_in_their_names() -> None:
    timing = LoopTiming()
    timing.missed, timing.longest_row, timing.collections = 3, 2, 1
    for duration in (1e-5, 2e-5, 4e-4):
        timing.lateness.add(duration)
        timing.cost.add(2.0 * duration)
    figures = timing.to_json()
    assert figures["ticks"] == 3
    assert [
        figures[k] for k in ("missed_deadlines", "most_missed_in_a_row", "garbage_collections")
    ] == [3, 2, 1]
    assert figures["lateness_max_us"] == pytest.approx(400.0)
    assert figures["tick_cost_max_us"] == pytest.approx(800.0)
    assert figures["lateness_p50_us"] == pytest.approx(20.5, abs=0.6)
    assert len(figures) == 14


def test_what_was_commanded_beyond_the_last_one_sent_is_a_finding() -> None:
    timing = LoopTiming()
    timing.add_difference(replace(REST, wheel_angle=(0.0, -1.7e-3, 0.0)), REST)
    timing.add_difference(replace(REST, p_WS_W=(0.0, 0.0, 9e-4)), REST)
    assert _unsent(timing) == ("ok", "")
    timing.add_difference(replace(REST, wheel_angle=(0.0, 0.0, 1.8e-3)), REST)
    assert _unsent(timing)[0] == "setpoints_unsent"
    assert timing.to_json()["wheel_difference_deg"] == pytest.approx(0.1031, abs=1e-4)
    assert timing.to_json()["stage_difference_mm"] == pytest.approx(0.9)
