"""Runs of a real aircraft, and of vehicles that fail on purpose.

Whatever happens, the log is finished and readable.
"""

from math import radians
from pathlib import Path

import numpy as np
import pytest
from short_scenario import Load

from atlas_cueing.cueing import PreviewParameters
from atlas_cueing.errors import InputError, OutputError, SlipConditionError, VehicleError
from atlas_cueing.recording import read_log
from atlas_cueing.run import fly as run_module
from atlas_cueing.run import run_scenario
from atlas_cueing.run.ticks import BLOCK
from atlas_cueing.scenario import Scenario, load_scenario

from .doubles import Double, raising, states


def test_a_real_flight(load: Load, tmp_path: Path) -> None:
    scenario = load("duration_s=0.45")  # at 0.5 s this script trims
    result = run_scenario(scenario, tmp_path / "log.mcap")
    assert (result.result, result.reason, result.clean) == ("ok", "", True)
    assert (result.ticks, result.duration) == (55, pytest.approx(0.45, abs=1e-6))
    assert result.log == tmp_path / "log.mcap"
    assert result.wall > 0.0
    log = read_log(result.log)
    assert len(log.column("/motion", "time_s")) == 55
    assert [(round(time, 5), state) for time, state in states(result.log)] == [
        (0.0, "running"),
        (0.45, "done"),
    ]
    assert log.attachments == scenario.attachments()
    assert log.metadata["scenario"] == "short"
    assert log.metadata["method"] == "hedge"
    assert log.metadata["platform"] == "atlas-2.9m"
    assert (log.metadata["result"], log.metadata["reason"]) == ("ok", "")
    assert all(
        log.metadata[f"{name}_version"][0].isdigit()
        for name in ("atlas_cueing", "jsbsim", "ruckig")
    )
    assert {path.name for path in tmp_path.iterdir()} == {"s.toml", "log.mcap"}


def test_json_has_the_promised_keys(load: Load, tmp_path: Path) -> None:
    result = run_scenario(load(), tmp_path / "log.mcap")
    table = result.to_json()
    assert set(table) >= {"result", "reason", "log", "ticks", "duration_s", "violations", "metrics"}
    metrics = table["metrics"]
    assert isinstance(metrics, dict)
    for name in (
        "force_rms_m_s2",
        "direction_rms_rad",
        "rate_rms_rad_s",
        "wheels_limited_share",
        "stage_limited_share",
    ):
        assert metrics[name] >= 0.0
    assert metrics["orientation_drift_max_rad"] < radians(0.05)


def test_the_same_run_gives_the_same_bytes(load: Load, tmp_path: Path) -> None:
    first, second = (
        run_scenario(load(), tmp_path / f"{i}.mcap").log.read_bytes() for i in range(2)
    )
    assert first == second
    other = run_scenario(load("cueing.memory_s=1"), tmp_path / "other.mcap").log.read_bytes()
    assert other != first


def test_a_log_alone_can_be_flown_again(load: Load, tmp_path: Path) -> None:
    log = run_scenario(load("platform.wheel_limits.speed_rad_s=20"), tmp_path / "log.mcap").log
    for name, content in read_log(log).attachments.items():
        (tmp_path / name).write_bytes(content)
    again = run_scenario(load_scenario(tmp_path / "scenario.toml"), tmp_path / "again.mcap").log
    assert again.read_bytes() == log.read_bytes()


def test_topics_left_out(load: Load, tmp_path: Path) -> None:
    with_tf = run_scenario(load(), tmp_path / "with.mcap").log
    without = run_scenario(load('recording.skip=["/tf"]'), tmp_path / "without.mcap").log
    assert b"foxglove.FrameTransforms" in with_tf.read_bytes()
    assert b"foxglove.FrameTransforms" not in without.read_bytes()


def test_a_crash_into_the_ground(load: Load, tmp_path: Path) -> None:
    """JSBSim itself: `cannonball` diverges in mid-run."""
    result = run_scenario(
        load("vehicle.script=cannonball", "duration_s=600"), tmp_path / "log.mcap"
    )
    assert result.result == "vehicle_failed"
    assert result.ticks > 10
    assert len(read_log(result.log).column("/motion", "time_s")) == result.ticks
    assert result.evaluation.violations == ()


def test_a_script_that_trims_in_mid_run(load: Load, tmp_path: Path) -> None:
    """JSBSim's own c1722 trims at 0.5 s: the attitude jumps, and the log says so."""
    found = states(run_scenario(load(), tmp_path / "log.mcap").log)
    assert [state for _, state in found] == ["running", "attitude_jump", "running", "done"]
    assert found[1][0] == pytest.approx(0.5, abs=0.01)


def test_progress_is_told_the_flight_time(load: Load, tmp_path: Path) -> None:
    times: list[float] = []
    run_scenario(load("vehicle.rate_hz=1000"), tmp_path / "log.mcap", progress=times.append)
    assert len(times) == -(-1001 // BLOCK)
    assert times == sorted(times)
    assert times[-1] <= 1.0


def refuse_to_fly(scenario: Scenario, folder: Path, error: type[InputError]) -> None:
    with pytest.raises(error):
        run_scenario(scenario, folder / "log.mcap")
    assert not list(folder.glob("log*"))


def test_nothing_is_written_for_bad_input(load: Load, tmp_path: Path) -> None:
    flat = [
        f"platform.wheel.{i}.contact={c}"
        for i, c in enumerate(
            ["[1,0,0]", "[-0.5,-0.8660254037844386,0]", "[-0.5,0.8660254037844386,0]"]
        )
    ]
    refuse_to_fly(load(*flat), tmp_path, SlipConditionError)
    refuse_to_fly(load("vehicle.script=unitconversions"), tmp_path, InputError)
    with pytest.raises(OutputError):
        run_scenario(load(), tmp_path / "missing" / "log.mcap")


def test_preview_knows_what_the_vehicle_will_do(load: Load, tmp_path: Path) -> None:
    """The vehicle is the one that any method flies; only the platform knows better."""
    plain, planned = (
        run_scenario(load(f"cueing.method={m}"), tmp_path / f"{m}.mcap")
        for m in ("blend", "preview")
    )
    assert planned.clean
    assert planned.ticks == plain.ticks
    one, other = (read_log(result.log) for result in (plain, planned))
    assert np.array_equal(one.tables["/vehicle"].values, other.tables["/vehicle"].values)
    assert one.statuses == other.statuses
    assert other.metadata["method"] == "preview"
    units = PreviewParameters()  # what it plans by
    force, rate = (
        np.array([result.evaluation.metrics[name] for result in (planned, plain)]) / unit
        for name, unit in (
            ("force_rms_m_s2", units.force_unit),
            ("rate_rms_rad_s", units.rate_unit),
        )
    )
    best, other = np.hypot(force, rate)
    assert best < other


def test_a_flight_that_fails_is_planned_up_to_there(
    load: Load, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    vehicle = Double(event=raising(VehicleError(0.5, "fell apart"), at=50))
    monkeypatch.setattr(run_module, "open_vehicle", lambda _: vehicle)
    result = run_scenario(load("cueing.method=preview"), tmp_path / "log.mcap")
    assert (result.result, result.ticks) == ("vehicle_failed", 50)
    assert "fell apart" in result.reason
    assert states(result.log)[-1] == (0.49, "vehicle_failed")


def test_a_flight_without_a_plan_writes_nothing(
    load: Load, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    vehicle = Double()
    vehicle.rate = (1e7, 0.0, 0.0)
    monkeypatch.setattr(run_module, "open_vehicle", lambda _: vehicle)
    with pytest.raises(InputError, match="no plan"):
        run_scenario(load("cueing.method=preview"), tmp_path / "log.mcap")
    assert [path.name for path in tmp_path.iterdir()] == ["s.toml"]
