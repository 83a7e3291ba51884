"""Wheels whose rollers stand at an angle: run and review agree on their effective radius."""

import json
from importlib.resources import files
from math import cos, radians
from pathlib import Path

import pytest
import tomli_w

from atlas_cueing.scenario.reading import parse_toml

from .conftest import Command


@pytest.mark.parametrize("angle", [0.0, 45.0, 70.0])
def test_a_ride_on_them_is_reviewed_clean(command: Command, angle: float) -> None:
    preset = files("atlas_cueing.scenario") / "presets" / "atlas-2.9m.toml"
    table = parse_toml(preset.read_text(), "platform.toml")
    for wheel in table["wheel"]:
        wheel |= {"roller_deg": angle, "radius_m": wheel["radius_m"] / cos(radians(angle))}
    Path("mecanum.toml").write_text(tomli_w.dumps(table))
    scenario = Path("s.toml").read_text()
    Path("s.toml").write_text(scenario.replace('preset = "atlas-2.9m"', 'file = "mecanum.toml"'))
    ended = command("run", "s.toml", "-o", "new.mcap")
    assert ended.status == 0, ended.err
    assert json.loads(command("review", "new.mcap", "--json").out)["findings"] == []
