"""`[traction] keep = true` by `run`, `recue` and `batch`, on a ride that slips without."""

import csv
import json
from pathlib import Path

import pytest

from .conftest import Command

KEEP = "platform.traction.keep=true"
ROLL = """
name = "roll"
duration_s = 3.0
[vehicle]
source = "jsbsim"
aircraft = "f16"
rate_hz = 120
input = [{ time_s = 0.5, property = "fcs/aileron-cmd-norm", value = 1.0, ramp_s = 0.0 }]
[vehicle.initial]
altitude_m = 3000.0
airspeed_m_s = 200.0
[platform]
preset = "atlas-2.9m"
[cueing]
method = "force"
"""


@pytest.fixture
def flight(tmp_path: Path) -> str:
    (tmp_path / "roll.toml").write_text(ROLL)
    return "roll.toml"


def test_a_ride_that_slips_is_ridden_again_with_traction_kept(
    command: Command, flight: str
) -> None:
    slips = json.loads(command("run", flight, "-o", "slips.mcap", "--json").out)
    assert slips["metrics"]["traction_slip_share"] > 0.0
    again = command("recue", "slips.mcap", "--set", KEEP, "-o", "kept.mcap", "--json")
    assert (again.status, again.err) == (0, "")
    kept = json.loads(again.out)["metrics"]
    assert kept["traction_slip_share"] == kept["lift_off_share"] == 0.0
    assert 0.7 < kept["traction_use_max"] <= 0.8  # the margin of the preset is 1.25
    flown = json.loads(command("run", flight, "--set", KEEP, "-o", "run.mcap", "--json").out)
    assert flown["metrics"] == kept
    assert "traction kept: 0.7" in command("review", "kept.mcap").out


def test_a_sweep_has_both(command: Command, flight: str, tmp_path: Path) -> None:
    sweep = ROLL + "[sweep]\nplatform.traction.keep = [false, true]\n"
    (tmp_path / flight).write_text(sweep)
    assert command("batch", flight, "-o", "out", "--jobs", "1").status == 0
    with (tmp_path / "out" / "summary.csv").open() as file:
        slips = {
            row["platform.traction.keep"]: float(row["traction_slip_share"])
            for row in csv.DictReader(file)
        }
    assert slips["False"] > 0.0
    assert slips["True"] == 0.0
