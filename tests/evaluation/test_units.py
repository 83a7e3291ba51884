"""Numbers in everyday units, and names in words."""

from math import inf, nan, pi

import pytest

from atlas_cueing.evaluation import DECLARED, Shown, shown
from atlas_cueing.evaluation.metric import Cell, Phrase
from atlas_cueing.evaluation.units import is_number, key_in_words, setting_text, typeset


@pytest.mark.parametrize(
    ("name", "value", "line", "text"),
    [
        ("direction_rms_rad", pi / 180.0, "direction rms deg", "1.000"),
        ("rate_max_rad_s", pi / 18.0, "rate max deg/s", "10.000"),
        ("coriolis_rms_rad_s2", pi, "coriolis rms deg/s2", "180.000"),
        ("wheel_speed_max_rad_s", 31.0, "wheel speed max rad/s", "31.000"),
        ("wheel_acceleration_residual_max_rad_s2", 1e-9, None, "0.000"),
        ("force_rms_m_s2", 1.2345, "force rms m/s2", "1.234"),
        ("stage_speed_max_m_s", 0.5, "stage speed max m/s", "0.500"),
        ("stage_travel_max_m", 0.12345, "stage travel max m", "0.1235"),
        ("wheels_limited_share", 0.125, "wheels limited %", "12.50"),
        ("force_x_delay_s", -0.0123, "force x delay s", "-0.0123"),
        ("duration_s", 12.0, "duration s", "12.00"),
        ("ticks", 721.0, "ticks", "721"),
        ("turns_roll", 3.99, "turns roll", "3.9900"),
        ("force_rms_m_s2", None, "force rms m/s2", "-"),
        ("force_rms_m_s2", inf, "force rms m/s2", "inf"),
    ],
)
def test_a_metric_in_words(name: str, value: float | None, line: str | None, text: str) -> None:
    metric = DECLARED[name]
    assert metric.unit.text(value) == text
    assert line is None or metric.line == line


@pytest.mark.parametrize("name", DECLARED)
def test_a_declaration_is_whole(name: str) -> None:
    metric = DECLARED[name]
    assert metric.name == name
    assert "_" not in metric.title
    assert metric.definition[0] == "9" or metric.definition[0].isupper()
    assert metric.definition.endswith(".")
    assert "rad" not in metric.unit.shown or name.startswith(("wheel_", "motor_"))
    assert all(
        definition is metric or definition.definition != metric.definition
        for definition in DECLARED.values()
    )


def names(place: Shown) -> list[str]:
    return [metric.name for metric in shown(place)]


def test_what_is_shown_where() -> None:
    errors = [f"{name}_rms_rad_s" for name in ("rate", "perceived_rate")]
    errors += [f"{name}_rms_m_s2" for name in ("force", "perceived_force")]
    assert {*errors, "direction_rms_rad", "attitude_rms_rad"} <= set(names(Shown.ERROR_HEADLINE))
    limited = ["wheels_limited_share", "stage_limited_share"]
    assert {"turns_roll", "turns_pitch", "turns_yaw", *limited} <= set(names(Shown.RUN_HEADLINE))
    assert names(Shown.HEADLINE) == names(Shown.ERROR_HEADLINE) + names(Shown.RUN_HEADLINE)
    perceived = {"mismatch", "perceived_tilt_rms_rad", "perceived_turn_rms_rad_s"}
    assert perceived <= set(names(Shown.ERROR_HEADLINE)) & set(names(Shown.BATCH))
    batch = ["force_rms_m_s2", "direction_rms_rad", "rate_rms_rad_s", *limited]
    assert [name for name in names(Shown.BATCH) if name in batch] == batch
    rows = [metric.summary.row for metric in DECLARED.values() if metric.summary]
    assert list(dict.fromkeys(rows)) == [
        *("mismatch", "specific force", "force direction", "angular rate", "attitude"),
        *("perceived", "net turns", "lag behind cue", "limited"),
        *("traction", "preload needed", "wheel torque", "power", "energy"),
    ]


def test_a_cell_is_in_a_whole_row() -> None:
    """Every row of the table that `run` prints has the same columns, in one unit."""
    rows: dict[str, list[tuple[str, str]]] = {}
    for metric in DECLARED.values():
        if isinstance(metric.summary, Cell):
            place = (metric.summary.column, metric.unit.shown)
            rows.setdefault(metric.summary.row, []).append(place)
    for cells in rows.values():
        assert [column for column, _ in cells] == ["rms", "p95", "max"]
        assert len({unit for _, unit in cells}) == 1


def test_a_phrase_is_a_format_of_one_number() -> None:
    for metric in DECLARED.values():
        if isinstance(metric.summary, Phrase):
            assert metric.summary.text.format(0.25) != metric.summary.text.format(0.5)


@pytest.mark.parametrize(
    ("key", "words", "unit"),
    [
        ("cueing.align_rate_deg_s", "align rate", "deg/s"),
        ("cueing.force_gain", "force gain", ""),
        ("vehicle.rate_hz", "rate", "Hz"),
        ("stage_limits.travel_m", "travel", "m"),
        ("stage_limits.jerk_m_s3", "jerk", "m/s3"),
        ("limits.speed_rad_s", "speed", "rad/s"),
        ("cueing.some_share", "some share", ""),
    ],
)
def test_a_key_in_words(key: str, words: str, unit: str) -> None:
    assert key_in_words(key) == (words, unit)


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.25, "0.25"), (3, "3"), ("blend", "blend"), ([1, 2], "[1, 2]"), (True, "True")],
)
def test_a_setting_is_shown_as_it_was_set(value: object, text: str) -> None:
    assert setting_text(value) == text


def test_exponents_are_raised() -> None:
    assert [typeset(symbol) for symbol in ("m/s2", "deg/s2", "m/s3", "rad/s", "s", "")] == [
        "m/s²",
        "deg/s²",
        "m/s³",
        "rad/s",
        "s",
        "",
    ]


def test_what_is_a_number() -> None:
    assert [is_number(value) for value in (1, 0.5, True, nan, -inf, None, "1")] == [
        *(True, True),
        *(False, False, False, False, False),
    ]
