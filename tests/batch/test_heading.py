from math import degrees, inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.batch import metric_names
from atlas_cueing.batch.heading import Heading, length_of
from atlas_cueing.review.figures import Figure


@pytest.mark.parametrize("name", metric_names())
def test_every_metric_is_in_the_unit_that_the_review_shows(name: str) -> None:
    """Two tables of units, of layers that do not know each other, say the same."""
    heading, figure = Heading.of_metric(name), Figure.of(name)
    assert heading.factor == figure.factor
    assert (
        figure.title.replace("m/s2", "m/s²")
        .replace("deg/s2", "deg/s²")
        .replace("rad/s2", "rad/s²")
        .endswith(heading.unit)
    )
    assert heading.line.split(",")[0].split(" ")[0] == figure.title.split(" ")[0]
    assert "_" not in heading.line
    assert "rad" not in heading.unit or name.startswith("wheel_")


@pytest.mark.parametrize(
    ("key", "line"),
    [
        ("cueing.align_rate_deg_s", "align rate, deg/s"),
        ("cueing.force_gain", "force gain"),
        ("vehicle.rate_hz", "rate, Hz"),
        ("stage_limits.travel_m", "travel, m"),
        ("limits.speed_rad_s", "speed, rad/s"),
        ("cueing.some_share", "some share"),
    ],
)
def test_a_key_is_shown_as_it_was_set(key: str, line: str) -> None:
    heading = Heading.of_key(key)
    assert heading.line == line
    assert (heading.text(0.25), heading.text(3), heading.text("blend"), heading.text([1, 2])) == (
        "0.25",
        "3",
        "blend",
        "[1, 2]",
    )
    assert heading.text(True) == "True"


@given(st.floats(-100.0, 100.0))
def test_a_figure_is_the_number_in_its_unit(value: float) -> None:
    assert float(Heading.of_metric("direction_rms_rad").text(value)) == pytest.approx(
        degrees(value), abs=0.00501
    )
    assert float(Heading.of_metric("wheels_limited_share").text(value)) == pytest.approx(
        100.0 * value, abs=0.0501
    )
    assert float(Heading.of_metric("wheel_speed_max_rad_s").text(value)) == pytest.approx(
        value, abs=0.00501
    )


@pytest.mark.parametrize("value", [None, nan, inf, -inf])
def test_no_number_is_a_dash(value: float | None) -> None:
    assert (
        Heading.of_metric("cost").text(value)
        == Heading.of_metric("force_rms_m_s2").text(value)
        == "–"
    )


@pytest.mark.parametrize(
    ("time", "text"),
    [(0.0, "0.0 s"), (59.0, "59.0 s"), (90.0, "1.5 min"), (3599.0, "60.0 min"), (9000.0, "2.5 h")],
)
def test_a_length_reads_well(time: float, text: str) -> None:
    assert length_of(time) == text
