"""Metrics in words and everyday units."""

from math import pi

import pytest

from atlas_cueing.review.figures import Figure, headlines


@pytest.mark.parametrize(
    ("name", "value", "title", "text"),
    [
        ("direction_rms_rad", pi / 180.0, "direction rms deg", "1.000"),
        ("rate_max_rad_s", pi / 18.0, "rate max deg/s", "10.000"),
        ("coriolis_rms_rad_s2", pi, "coriolis rms deg/s2", "180.000"),
        ("wheel_speed_max_rad_s", 31.0, "wheel speed max rad/s", "31.000"),
        ("force_rms_m_s2", 1.2345, "force rms m/s2", "1.234"),
        ("stage_speed_max_m_s", 0.5, "stage speed max m/s", "0.500"),
        ("stage_travel_max_m", 0.12345, "stage travel max m", "0.1235"),
        ("wheels_limited_share", 0.125, "wheels limited %", "12.50"),
        ("force_x_delay_s", -0.0123, "force x delay s", "-0.0123"),
        ("duration_s", 12.0, "duration s", "12.00"),
        ("ticks", 721.0, "ticks", "721"),
        ("turns_roll", 3.99, "turns roll", "3.9900"),
        ("something_new", 1.0, "something new", "1.0000"),
        ("force_rms_m_s2", None, "force rms m/s2", "-"),
    ],
)
def test_names_and_units(name: str, value: float | None, title: str, text: str) -> None:
    assert (Figure.of(name).title, Figure.of(name).text(value)) == (title, text)


def test_headlines_take_what_is_there() -> None:
    metrics = {
        "force_rms_m_s2": 1.0,
        "force_max_m_s2": 2.0,
        "turns_yaw": 3.0,
        "stage_limited_share": 0.5,
        "odd_rms_m": 1.0,
    }
    assert headlines(metrics) == [
        ("force rms m/s2", "1.000"),
        ("turns yaw", "3.0000"),
        ("stage limited %", "50.00"),
    ]
    assert headlines({}) == []
