import pickle
import subprocess
import sys
from math import degrees, inf
from pathlib import Path
from typing import Any

import pytest
import tomli_w
from pydantic import TypeAdapter, ValidationError

from atlas_cueing.cueing import (
    CAUSAL_METHODS,
    CLASSICAL_STAGE,
    DEFAULT_METHOD,
    METHODS,
    AttitudeParameters,
    BlendParameters,
    ClassicalParameters,
    ForceParameters,
    PreviewParameters,
    StageParameters,
)
from atlas_cueing.scenario.cueing_table import TABLES, CueingTable, MethodTable

ROLLS = Path(__file__).parents[2] / "scenarios" / "f16_rolls.toml"

adapter: TypeAdapter[MethodTable] = TypeAdapter(CueingTable)


@pytest.mark.parametrize("name", METHODS)
def test_defaults_are_those_of_the_declaration(name: str) -> None:
    """To the last bit, although the file has degrees."""
    assert TABLES[name]().parameters() == METHODS[name].defaults


@pytest.mark.parametrize("name", CAUSAL_METHODS)
def test_the_stage_has_the_defaults_of_the_declaration(name: str) -> None:
    assert TABLES[name]().stage_parameters() == METHODS[name].stage


@pytest.mark.parametrize("name", METHODS)
def test_a_table_goes_to_another_process(name: str) -> None:
    table = adapter.validate_python({"method": name})
    copied = pickle.loads(pickle.dumps(table))  # noqa: S301
    assert (type(copied), copied) == (type(table), table)
    assert copied.model_fields_set == table.model_fields_set


def degrees_of(table: Any) -> dict[str, float]:
    """Every number in degrees of a table, those of lists and of tables within as well."""
    found: dict[str, float] = {}
    for key, value in table.items():
        inner = value if isinstance(value, dict) else {}
        found |= {f"{key}.{name}": number for name, number in degrees_of(inner).items()}
        numbers = value if isinstance(value, (list, tuple)) else [value]
        found |= {f"{key}.{n}": x for n, x in enumerate(numbers) if "_deg" in key and x is not None}
    return found


@pytest.mark.parametrize("name", METHODS)
def test_degrees_read_well(name: str) -> None:
    """A default is 3 deg/s, and not 3.0000000000000004, though the program has it in radians."""
    found = degrees_of(TABLES[name]().model_dump())
    assert found or name == "still"
    for key, value in found.items():
        assert value == float(f"{value:.4g}"), key


CLASSICAL = """\
rotation_gain = [
    0.6,
    0.6,
    0.6,
]
force_gain = [
    0.6,
    0.6,
    0.5,
]
method = "classical"
high_pass_rad_s = [
    1.0,
    0.8,
    1.0,
]
tilt_low_pass_rad_s = 2.0
tilt_rate_deg_s = 3.0
angle_limit_deg = 25.0

[stage]
planner = "onset"
onset_rad_s = [
    0.8,
    1.0,
    1.0,
]
recentre_rad_s = [
    0.0,
    0.0,
    0.2,
]
bandwidth_hz = 5.0
travel_m = [
    0.6,
    0.6,
    0.6,
]
planning_rate_hz = 50.0
horizon_s = 5.0
memory_s = 15.0
first_share = 0.2
"""


def test_the_written_table_keeps_its_order() -> None:
    """Logs hold it, and the same run has the same log to the last byte."""
    assert tomli_w.dumps(TABLES["classical"]().model_dump(exclude_none=True)) == CLASSICAL


def test_the_table_s_help_lists_its_keys() -> None:
    for name, table in TABLES.items():
        text = table.__doc__ or ""
        assert METHODS[name].summary in text
        stage = table.model_fields.get("stage")
        inner = [f"stage.{key}" for key in type(stage.default).model_fields] if stage else []
        for key in (set(table.model_fields) - {"method", "stage"}) | set(inner):
            assert f"\n{key} = " in text


def test_every_key_of_blend_arrives() -> None:
    table = adapter.validate_python(
        {
            "method": "blend",
            "rotation_gain": [1, 2, 3],
            "force_gain": 0.5,
            "align_rate_deg_s": 2,
            "align_time_s": 5.0,
            "align_smoothing_s": 0.25,
            "hold_force_m_s2": 4.0,
            "stage": {
                "onset_rad_s": 2.5,
                "recentre_rad_s": [0.3, 0, 0.1],
                "bandwidth_hz": 8,
                "travel_m": [0.5, 0.6, 0.7],
            },
        }
    )
    method = table.parameters()
    assert isinstance(method, BlendParameters)
    assert method.rotation_gain == (1.0, 2.0, 3.0)
    assert degrees(method.turn.rate) == pytest.approx(2.0)
    assert (method.turn.time, method.turn.smoothing, method.hold) == (5.0, 0.25, 4.0)
    assert table.stage_parameters() == StageParameters(
        (0.5,) * 3, (2.5,) * 3, (0.3, 0.0, 0.1), 8.0, (0.5, 0.6, 0.7)
    )


def test_every_key_of_attitude_arrives() -> None:
    table = adapter.validate_python(
        {
            "method": "attitude",
            "rotation_gain": 0.5,
            "return_rate_deg_s": 1,
            "return_time_s": 4,
            "return_smoothing_s": 2,
        }
    )
    method = table.parameters()
    assert isinstance(method, AttitudeParameters)
    assert method.rotation_gain == (0.5, 0.5, 0.5)
    assert degrees(method.turn.rate) == pytest.approx(1.0)
    assert (method.turn.time, method.turn.smoothing) == (4.0, 2.0)


def test_every_key_of_force_arrives() -> None:
    table = adapter.validate_python(
        {
            "method": "force",
            "rotation_gain": [1, 2, 3],
            "force_gain": [0, 0.5, 1],
            "bandwidth_rad_s": 3,
            "align_rate_deg_s": 720,
            "align_time_s": 5.0,
            "align_smoothing_s": 0.25,
            "hold_force_m_s2": 4.0,
            "stage": {"travel_m": 0.25},
        }
    )
    method = table.parameters()
    assert isinstance(method, ForceParameters)
    assert (method.rotation_gain, method.bandwidth, method.hold) == ((1.0, 2.0, 3.0), 3.0, 4.0)
    assert degrees(method.turn.rate) == pytest.approx(720.0)
    assert (method.turn.time, method.turn.smoothing) == (5.0, 0.25)
    assert table.stage_parameters() == StageParameters((0.0, 0.5, 1.0), travel=(0.25, 0.25, 0.25))


def test_every_key_of_classical_arrives() -> None:
    """The gain of the force is that of the tilt and of the stage.

    Its stage keeps the set's numbers but those given.
    """
    table = adapter.validate_python(
        {
            "method": "classical",
            "rotation_gain": [0.1, 0.2, 0.3],
            "force_gain": [0.4, 0.5, 0.6],
            "high_pass_rad_s": [0.7, 0.8, 0.9],
            "tilt_low_pass_rad_s": 1.5,
            "tilt_rate_deg_s": 5,
            "angle_limit_deg": 1e6,
            "stage": {
                "onset_rad_s": 1.1,
                "recentre_rad_s": 0,
                "bandwidth_hz": 7,
                "travel_m": [0.1, 0.2, 0.3],
            },
        }
    )
    method = table.parameters()
    assert isinstance(method, ClassicalParameters)
    assert (method.rotation_gain, method.tilt_gain) == ((0.1, 0.2, 0.3), (0.4, 0.5, 0.6))
    assert (method.high_pass, method.tilt_low_pass) == ((0.7, 0.8, 0.9), 1.5)
    assert (degrees(method.tilt_rate), degrees(method.angle_limit)) == (
        pytest.approx(5.0),
        pytest.approx(1e6),
    )
    assert table.stage_parameters() == StageParameters(
        (0.4, 0.5, 0.6), (1.1,) * 3, (0.0,) * 3, 7.0, (0.1, 0.2, 0.3), "onset"
    )


@pytest.mark.parametrize("stage", [{}, {"bandwidth_hz": 5}])
def test_a_stage_table_of_classical_keeps_the_set_for_what_it_leaves_out(
    stage: dict[str, float],
) -> None:
    """Writing down a default changes nothing."""
    table = adapter.validate_python({"method": "classical", "stage": stage})
    assert table.stage_parameters() == CLASSICAL_STAGE


def test_without_a_travel_the_platform_s_counts() -> None:
    assert adapter.validate_python({"method": "force"}).stage_parameters().travel == (inf, inf, inf)


def test_the_table_of_a_method_is_built_when_it_is_asked_for() -> None:
    """All of them take longer than the rest of a scenario."""
    code = (
        "from atlas_cueing.scenario import load_scenario\n"
        "from atlas_cueing.scenario.cueing_table import PackageMethodTable\n"
        f"load_scenario({str(ROLLS)!r}, ['cueing.method=still'])\n"
        "print(*sorted(table.__name__ for table in PackageMethodTable.__subclasses__()))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["HedgeTable", "StillTable"]  # hedge: the default


def test_hedge_is_the_default() -> None:
    assert DEFAULT_METHOD == "hedge"
    assert isinstance(adapter.validate_python({}), TABLES["hedge"])


def test_every_key_of_preview_arrives() -> None:
    table = adapter.validate_python(
        {
            "method": "preview",
            "align_rate_deg_s": 180,
            "align_smoothing_s": 0.1,
            "force_unit_m_s2": 0.3,
            "rate_unit_deg_s": 6,
            "planning_rate_hz": 50,
        }
    )
    method = table.parameters()
    assert isinstance(method, PreviewParameters)
    assert (degrees(method.rate), degrees(method.rate_unit)) == pytest.approx((180.0, 6.0))
    assert (method.smoothing, method.force_unit, method.planning_rate) == (0.1, 0.3, 50.0)


@pytest.mark.parametrize(
    "bad",
    [
        {"method": "foresight"},
        {"method": "preview", "force_gain": 0.5},
        {"method": "preview", "align_rate_deg_s": 0},
        {"method": "preview", "planning_rate_hz": 1000},
        {"method": "classical", "align_rate_deg_s": 1.0},
        {"method": "force", "tilt_rate_deg_s": 1.0},
        {"method": "classical", "angle_limit_deg": 0},
        {"method": "classical", "angle_limit_deg": float("inf")},
        {"method": "classical", "angle_limit_deg": 1.1e6},
        {"method": "classical", "high_pass_rad_s": [1, 0, 1]},
        {"method": "classical", "tilt_rate_deg_s": 91},
        {"method": "force", "align_rate_deg_s": 721},
        {"method": "force", "bandwidth_rad_s": 0},
        {"method": "blend", "align_rate_deg_s": 180},
        {"method": "force", "hold_force_m_s2": 0},
        {"method": "attitude", "align_rate_deg_s": 1.0},
        {"method": "blend", "return_rate_deg_s": 1.0},
        {"align_rate_deg_s": 0},
        {"align_time_s": 0},
        {"force_gain": -1},
        {"rotation_gain": [1, 1, 11]},
        {"stage": {"bandwidth_hz": 0}},
        {"stage": {"onset_rad_s": [1, 1]}},
        {"stage": {"onset_rad_s": 0}},
        {"stage": {"recentre_rad_s": -1}},
        {"stage": {"travel_m": 0}},
        {"stage": {"travel_m": [1, 1, float("inf")]}},
    ],
    ids=str,
)
def test_refused(bad: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        adapter.validate_python(bad)
