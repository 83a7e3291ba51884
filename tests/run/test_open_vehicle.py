"""Every source is opened in one way, and ends when the scenario says so."""

from pathlib import Path

import numpy as np
import pytest
from scenario.texts import AIRCRAFT, SCRIPT, SIGNALS

from atlas_cueing.errors import InputError
from atlas_cueing.recording import write_vehicle_log
from atlas_cueing.run import flight_length, open_vehicle, run_scenario
from atlas_cueing.scenario import load_scenario
from atlas_cueing.vehicles import Flight, LimitedDuration

RECORDING = (
    'name = "again"\n[vehicle]\nsource = "recording"\nlog = "s.mcap"\n[platform]\n'
    'preset = "atlas-2.9m"\n'
)


def end(folder: Path, text: str, *settings: str, live: bool = False) -> float:
    (folder / "scenario.toml").write_text(text)
    vehicle = open_vehicle(load_scenario(folder / "scenario.toml", settings), live=live)
    while vehicle.advance():
        pass
    return vehicle.state.time


@pytest.mark.parametrize("text", [SCRIPT, AIRCRAFT, SIGNALS], ids=["script", "aircraft", "signal"])
def test_the_duration_ends_every_source(tmp_path: Path, text: str) -> None:
    assert end(tmp_path, text, "duration_s=0.3") == pytest.approx(0.3, abs=0.02)


def test_the_duration_ends_a_recording(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(SCRIPT)
    run_scenario(load_scenario(tmp_path / "s.toml"), tmp_path / "s.mcap")
    assert end(tmp_path, RECORDING, live=True) == pytest.approx(0.5, abs=0.01)
    assert end(tmp_path, RECORDING, "duration_s=0.3", live=True) == pytest.approx(0.3, abs=0.01)
    assert end(tmp_path, RECORDING) == end(tmp_path, RECORDING, live=True)


def test_a_gap_is_input_that_does_not_come_and_no_flight_without_a_clock(tmp_path: Path) -> None:
    rows = np.zeros((9, 11))
    rows[:, 0], rows[:, 1] = 0.1 * np.array([0, 1, 2, 3, 6, 7, 8, 9, 10]), 1.0
    (tmp_path / "s.mcap").write_bytes(write_vehicle_log(rows, {}, {}))
    assert end(tmp_path, RECORDING, live=True) == pytest.approx(1.0)
    with pytest.raises(InputError, match=r"2 states missing between 0\.300000 and 0\.600000 s"):
        end(tmp_path, RECORDING)


def test_signals_end_with_the_last_one_or_go_on_for_the_duration(tmp_path: Path) -> None:
    assert end(tmp_path, SIGNALS) == pytest.approx(2.5)
    assert end(tmp_path, SIGNALS, "duration_s=4") == pytest.approx(4.0)


def test_a_script_without_a_duration_is_flown_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(SCRIPT.replace("duration_s = 0.5", ""))
    assert not isinstance(open_vehicle(load_scenario(tmp_path / "s.toml")), LimitedDuration)


def length(folder: Path, text: str, *settings: str) -> float | None:
    (folder / "s.toml").write_text(text)
    scenario = load_scenario(folder / "s.toml", settings)
    flight: Flight = scenario.flight
    return flight_length(flight, scenario.file.duration_s)


def test_the_length_is_known_beforehand(tmp_path: Path) -> None:
    endless = SCRIPT.replace("duration_s = 0.5", "")
    assert length(tmp_path, SCRIPT) == 0.5
    assert length(tmp_path, endless, "vehicle.script=737_test") == 1.0
    assert length(tmp_path, endless, "vehicle.script=737_test", "duration_s=5") == 1.0
    assert length(tmp_path, AIRCRAFT) == 0.5
    assert length(tmp_path, SIGNALS) == 2.5
    assert length(tmp_path, SIGNALS, "duration_s=4") == 4.0
