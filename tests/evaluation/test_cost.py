"""The one number that planning makes least."""

from math import hypot, radians, sqrt

import numpy as np
import pytest

from atlas_cueing.cueing import PreviewParameters
from atlas_cueing.evaluation import RunColumns, gathered
from atlas_cueing.evaluation.cost import combined
from atlas_cueing.evaluation.cues import FORCE_THRESHOLD, RATE_THRESHOLD
from atlas_cueing.evaluation.deviation import Deviation

from .flights import G, column, sine, still


def cost(flight: RunColumns) -> dict[str, float]:
    figures = gathered(Deviation(), flight)
    return {name: figures[name] for name in ("cost", "cost_force", "cost_rate")}


def test_what_is_felt_as_it_should_be_costs_nothing() -> None:
    assert cost(still(100)) == {"cost": 0.0, "cost_force": 0.0, "cost_rate": 0.0}
    assert cost(still(0))["cost"] == 0.0


def test_an_error_at_its_threshold_all_the_way_costs_one() -> None:
    assert cost(still(10, felt_f=np.array([0.0, 0.17, -G])))["cost"] == pytest.approx(1.0)
    assert cost(still(10, felt_w=np.array([radians(3.0), 0.0, 0.0])))["cost"] == pytest.approx(1.0)


def test_a_degree_of_direction_costs_one() -> None:
    off = radians(1.0)
    assert cost(still(10, felt_f=G * np.array([0.0, np.sin(off), -np.cos(off)])))[
        "cost"
    ] == pytest.approx(1.0, rel=0.01)


def test_parts_add_up_as_squares_and_ticks_as_a_mean() -> None:
    force, rate = column(sine(400, 0.34, 3), 1), column(sine(400, 0.1, 5), 2)
    figures = cost(still(400, felt_f=force + np.array([0.0, 0.0, -G]), felt_w=rate))
    assert figures["cost_force"] == pytest.approx(2.0 / sqrt(2.0))
    assert figures["cost_rate"] == pytest.approx(0.1 / radians(3.0) / sqrt(2.0))
    assert figures["cost"] == pytest.approx(hypot(figures["cost_force"], figures["cost_rate"]))
    assert combined(0.34 / sqrt(2.0), 0.1 / sqrt(2.0)) == pytest.approx(figures)


def test_the_vehicle_s_own_motion_is_what_counts() -> None:
    turning = np.array([0.3, -0.2, 0.1])
    assert cost(still(10, felt_w=turning, vehicle_w_B=turning))["cost"] == 0.0
    assert cost(still(10, felt_w=turning))["cost"] == cost(still(10, vehicle_w_B=turning))["cost"]


def test_units_are_the_thresholds_of_a_pilot() -> None:
    parameters = PreviewParameters()
    assert parameters.force_unit == FORCE_THRESHOLD[1]
    assert parameters.rate_unit == RATE_THRESHOLD[0]
