"""Keys with their units, and parameters set from the values of a file."""

from dataclasses import dataclass
from math import inf, pi, radians

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing.parameter import (
    UNITS,
    Choice,
    Parameter,
    Range,
    Unit,
    Value,
    with_values,
)
from atlas_cueing.rotation import Vec3

ANY = Range(0.0, 1e6)


@dataclass(frozen=True)
class Inner:
    rate: float = radians(3.0)
    other: float = 1.0


@dataclass(frozen=True)
class Outer:
    gain: Vec3 = (1.0, 1.0, 1.0)
    angles: Vec3 = (pi, 0.0, radians(25.0))
    travel: Vec3 = (inf, inf, inf)
    limit: float = inf
    word: str = "one"
    turn: Inner = Inner()


def parameter(key: str, field: str) -> Parameter:
    return Parameter(key, field, ANY, "does something", "assumed")


KEYS = (
    parameter("gain", "gain"),
    parameter("angles_deg", "angles"),
    parameter("travel_m", "travel"),
    parameter("limit_m_s2", "limit"),
    Parameter("word", "word", Choice(("one", "two")), "does something", "assumed"),
    parameter("turn_rate_deg_s", "turn.rate"),
)


@pytest.mark.parametrize(
    ("key", "symbol"),
    [
        ("gain", ""),
        ("first_share", ""),
        ("time_s", "s"),
        ("rate_deg_s", "deg/s"),
        ("corner_rad_s", "rad/s"),
        ("force_m_s2", "m/s^2"),
        ("speed_m_s", "m/s"),
        ("angle_deg", "deg"),
        ("angle_rad", "rad"),
        ("rate_hz", "Hz"),
        ("travel_m", "m"),
    ],
)
def test_the_unit_is_the_end_of_the_key(key: str, symbol: str) -> None:
    assert parameter(key, "gain").unit.symbol == symbol


def test_no_end_hides_a_longer_one() -> None:
    ends = list(UNITS)
    assert not [
        (end, longer)
        for i, end in enumerate(ends)
        for longer in ends[i + 1 :]
        if longer.endswith(end)
    ]


@given(st.integers(-10_000, 10_000))
def test_degrees_come_back_as_they_were_written(hundredths: int) -> None:
    unit, angle = Unit("deg", in_degrees=True), hundredths / 100.0
    assert unit.from_si(unit.to_si(angle)) == angle
    assert unit.to_si(unit.from_si(radians(angle))) == radians(angle)


def test_defaults_are_in_the_units_of_the_file_and_no_bound_is_none() -> None:
    assert [key.default(Outer()) for key in KEYS] == [
        (1.0, 1.0, 1.0),
        (180.0, 0.0, 25.0),
        None,
        None,
        "one",
        3.0,
    ]


def test_values_arrive_in_si_and_all_else_stays() -> None:
    values: dict[str, Value | None] = {
        "gain": (1.0, 2.0, 3.0),
        "angles_deg": (90.0, 0.0, 180.0),
        "travel_m": None,
        "limit_m_s2": 2.0,
        "word": "two",
        "turn_rate_deg_s": 180.0,
        "of another table": 3.0,
    }
    inner = Inner(rate=pi, other=1.0)
    expected = Outer((1.0, 2.0, 3.0), (pi / 2, 0.0, pi), (inf, inf, inf), 2.0, "two", inner)
    assert with_values(Outer(), KEYS, values) == expected


def test_ranges_and_choices_read_as_messages_write_them() -> None:
    assert str(Range(0.0, 90.0, above=True)) == "0 < value <= 90"
    assert str(Range(0.01, 1000.0)) == "0.01 <= value <= 1000"
    assert str(Choice(("horizon", "onset"))) == "horizon or onset"
