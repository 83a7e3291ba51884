from math import degrees
from typing import get_args

import pytest
from pydantic import TypeAdapter, ValidationError

from atlas_cueing.cueing import AttitudeParameters, BlendParameters, StageParameters
from atlas_cueing.scenario.cueing import METHODS, AttitudeTable, BlendTable, CueingTable

adapter: TypeAdapter[AttitudeTable | BlendTable] = TypeAdapter(CueingTable)


def test_defaults_are_those_of_the_cueing_itself() -> None:
    """To the last bit, although the file has degrees."""
    assert AttitudeTable().parameters() == AttitudeParameters()
    assert BlendTable().parameters() == BlendParameters()
    for table in (AttitudeTable(), BlendTable()):
        assert table.stage_parameters() == StageParameters()


def test_degrees_read_well() -> None:
    assert BlendTable().align_rate_deg_s == 3.0
    assert AttitudeTable().return_rate_deg_s == 3.0


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
            "stage": {"onset_rad_s": 2.5, "recentre_rad_s": 0.3, "bandwidth_hz": 8},
        }
    )
    method = table.parameters()
    assert isinstance(method, BlendParameters)
    assert method.rotation_gain == (1.0, 2.0, 3.0)
    assert degrees(method.turn.rate) == pytest.approx(2.0)
    assert (method.turn.time, method.turn.smoothing, method.hold) == (5.0, 0.25, 4.0)
    assert table.stage_parameters() == StageParameters((0.5, 0.5, 0.5), 2.5, 0.3, 8.0)


def test_every_key_of_attitude_arrives() -> None:
    table = adapter.validate_python(
        {"method": "attitude", "rotation_gain": 0.5, "return_rate_deg_s": 1, "return_time_s": 4, "return_smoothing_s": 2}
    )
    method = table.parameters()
    assert isinstance(method, AttitudeParameters)
    assert method.rotation_gain == (0.5, 0.5, 0.5)
    assert degrees(method.turn.rate) == pytest.approx(1.0)
    assert (method.turn.time, method.turn.smoothing) == (4.0, 2.0)


def test_blend_is_the_default() -> None:
    assert isinstance(adapter.validate_python({}), BlendTable)


def test_the_list_of_methods_is_the_union() -> None:
    union, _ = get_args(CueingTable)
    tables = [get_args(branch)[0] for branch in get_args(union)]
    assert list(METHODS.values()) == tables
    assert [table.model_fields["method"].default for table in tables] == list(METHODS)


@pytest.mark.parametrize(
    "bad",
    [
        {"method": "classical"},
        {"method": "attitude", "align_rate_deg_s": 1.0},
        {"method": "blend", "return_rate_deg_s": 1.0},
        {"align_rate_deg_s": 0},
        {"align_time_s": 0},
        {"force_gain": -1},
        {"rotation_gain": [1, 1, 11]},
        {"stage": {"bandwidth_hz": 0}},
    ],
    ids=str,
)
def test_refused(bad: dict) -> None:
    with pytest.raises(ValidationError):
        adapter.validate_python(bad)
