from math import degrees, inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.batch import METRIC_COLUMNS
from atlas_cueing.batch.column import Column


@pytest.mark.parametrize("name", METRIC_COLUMNS)
def test_a_metric_says_its_name_and_definition(name: str) -> None:
    column, metric = Column.of_metric(name), METRIC_COLUMNS[name]
    assert column.tip == f"{name}: {metric.definition}"
    assert "_" not in column.line
    assert column.cell(0.25) == metric.unit.text(0.25)


def test_units_are_typeset() -> None:
    assert Column.of_metric("coriolis_rms_rad_s2").line == "coriolis rms, deg/s²"
    assert Column.of_metric("violations").line == "violations"
    assert Column.of_metric("wall_s").line == "wall, s"


def test_a_key_is_shown_as_it_was_set() -> None:
    column = Column.of_key("cueing.align_rate_deg_s")
    assert (column.line, column.tip) == ("align rate, deg/s", "cueing.align_rate_deg_s")
    assert [column.cell(value) for value in (0.25, 3, "blend", True)] == [
        "0.25",
        "3",
        "blend",
        "True",
    ]


@given(st.floats(-100.0, 100.0))
def test_a_figure_is_the_number_in_its_unit(value: float) -> None:
    angle, share, wheel = (
        float(Column.of_metric(name).cell(value))
        for name in ("direction_rms_rad", "wheels_limited_share", "wheel_speed_max_rad_s")
    )
    assert angle == pytest.approx(degrees(value), abs=0.000501)
    assert share == pytest.approx(100.0 * value, abs=0.00501)
    assert wheel == pytest.approx(value, abs=0.000501)


@pytest.mark.parametrize("value", [None, nan, inf, -inf])
def test_no_number_is_a_dash(value: float | None) -> None:
    assert (
        Column.of_metric("mismatch").cell(value) == Column.of_key("cueing.gain").cell(value) == "–"
    )
