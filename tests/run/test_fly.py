"""Runs of a real aircraft, and of vehicles that fail on purpose.

Whatever happens, the log is finished and readable.
"""

import signal
from collections.abc import Callable
from math import radians
from pathlib import Path

import numpy as np
import pytest
from short_scenario import Load

from atlas_cueing.cueing import PreviewParameters
from atlas_cueing.errors import InputError, OutputError, SlipConditionError, VehicleError
from atlas_cueing.recording import McapRecorder, read_log
from atlas_cueing.rotation import IDENTITY, Quat, Vec3, exp
from atlas_cueing.run import RunResult, run_scenario
from atlas_cueing.run import fly as run_module
from atlas_cueing.run.ticks import BLOCK
from atlas_cueing.scenario import Scenario, load_scenario
from atlas_cueing.signals import STANDARD_GRAVITY, Tick, VehicleState

Event = Callable[[int], None]
DT = 0.01


class Double:
    """A vehicle at rest for `ticks` steps, in whatever attitude.

    `event` is called at each step with its number.
    """

    def __init__(
        self,
        ticks: int = 100,
        event: Event = lambda _: None,
        attitude: Callable[[int], Quat] = lambda _: IDENTITY,
    ) -> None:
        self._ticks, self._event, self._attitude = ticks, event, attitude
        self._tick = 0
        self.rate: Vec3 = (0.0, 0.0, 0.0)

    @property
    def dt(self) -> float:
        return DT

    @property
    def state(self) -> VehicleState:
        return VehicleState(
            self._tick * DT, self._attitude(self._tick), self.rate, (0.0, 0.0, -STANDARD_GRAVITY)
        )

    def advance(self) -> bool:
        self._tick += 1
        self._event(self._tick)
        return self._tick <= self._ticks


Fly = Callable[[Double], RunResult]


@pytest.fixture
def fly(load: Load, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Fly:
    """Run the scenario with a double in the place of JSBSim."""

    def run(vehicle: Double) -> RunResult:
        monkeypatch.setattr(run_module, "open_vehicle", lambda _: vehicle)
        return run_scenario(load(), tmp_path / "log.mcap")

    return run


def raising(error: BaseException, at: int) -> Event:
    def event(tick: int) -> None:
        if tick == at:
            raise error

    return event


def states(log: Path) -> list[tuple[float, str]]:
    return [(round(status.time, 9), status.state) for status in read_log(log).statuses]


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


def test_a_vehicle_that_fails(fly: Fly) -> None:
    result = fly(Double(event=raising(VehicleError(0.42, "the wing came off"), 42)))
    assert (result.result, result.reason) == (
        "vehicle_failed",
        "vehicle failed at 0.420 s: the wing came off",
    )
    assert not result.clean
    assert result.ticks == 42
    log = read_log(result.log)
    assert len(log.column("/wheels", "time_s")) == 42
    assert log.metadata["result"] == "vehicle_failed"
    assert states(result.log) == [(0.0, "running"), (0.41, "vehicle_failed")]
    assert log.statuses[-1].reason == result.reason


def test_a_vehicle_that_fails_at_once(
    load: Load, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(_: object) -> None:
        raise VehicleError(0.0, "no trim")

    monkeypatch.setattr(run_module, "open_vehicle", fail)
    result = run_scenario(load(), tmp_path / "log.mcap")
    assert (result.result, result.ticks, result.duration) == ("vehicle_failed", 0, 0.0)
    assert read_log(result.log).metadata["reason"] == "vehicle failed at 0.000 s: no trim"
    assert not result.evaluation.violations


def test_a_crash_into_the_ground(load: Load, tmp_path: Path) -> None:
    """JSBSim itself: `cannonball` diverges in mid-run."""
    result = run_scenario(
        load("vehicle.script=cannonball", "duration_s=600"), tmp_path / "log.mcap"
    )
    assert result.result == "vehicle_failed"
    assert result.ticks > 10
    assert len(read_log(result.log).column("/motion", "time_s")) == result.ticks
    assert result.evaluation.violations == ()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_flight_after_the_tick(fly: Fly, number: signal.Signals) -> None:
    result = fly(Double(event=lambda tick: signal.raise_signal(number) if tick == 10 else None))
    assert (result.result, result.ticks) == ("interrupted", 11)
    assert result.reason == "asked to stop at 0.100 s"
    assert states(result.log) == [(0.0, "running"), (0.1, "interrupted")]


def test_a_keyboard_interrupt_out_of_nowhere(fly: Fly) -> None:
    result = fly(Double(event=raising(KeyboardInterrupt(), 10)))
    assert (result.result, result.ticks) == ("interrupted", 10)
    assert read_log(result.log).metadata["result"] == "interrupted"


def test_an_error_that_nobody_expected_is_raised_after_the_log_is_finished(
    fly: Fly, tmp_path: Path
) -> None:
    with pytest.raises(ZeroDivisionError):
        fly(Double(event=raising(ZeroDivisionError("oops"), 10)))
    log = read_log(tmp_path / "log.mcap")
    assert (log.metadata["result"], log.metadata["reason"]) == ("failed", "ZeroDivisionError: oops")
    assert len(log.column("/motion", "time_s")) == 10


def test_a_full_disk_in_mid_run(fly: Fly, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    append = McapRecorder.append

    def failing(recorder: McapRecorder, tick: Tick) -> None:
        if tick.vehicle.time > 0.5:
            raise OutputError("No space left on device")
        append(recorder, tick)

    monkeypatch.setattr(McapRecorder, "append", failing)
    result = fly(Double())
    assert (result.result, result.reason) == ("recording_failed", "No space left on device")
    assert not result.clean
    assert result.log == tmp_path / "log.mcap.part"
    assert result.log.stat().st_size > 0
    assert not (tmp_path / "log.mcap").exists()


def test_a_script_that_trims_in_mid_run(load: Load, tmp_path: Path) -> None:
    """JSBSim's own c1722 trims at 0.5 s: the attitude jumps, and the log says so."""
    found = states(run_scenario(load(), tmp_path / "log.mcap").log)
    assert [state for _, state in found] == ["running", "attitude_jump", "running", "done"]
    assert found[1][0] == pytest.approx(0.5, abs=0.01)


def test_jumps_are_noted_once_each(fly: Fly) -> None:
    """Two jumps of 10 deg, at ticks 20 and 40: noted when they happen, and over a tick later."""
    result = fly(Double(60, attitude=lambda tick: exp((radians(10.0) * (tick // 20), 0.0, 0.0))))
    assert states(result.log) == [
        (0.0, "running"),
        *(
            (0.2, "attitude_jump"),
            (0.21, "running"),
            (0.4, "attitude_jump"),
            (0.41, "running"),
            (0.6, "attitude_jump"),
        ),
        (0.6, "done"),
    ]
    assert "10 deg" in read_log(result.log).statuses[1].reason


def test_a_turn_that_the_rates_explain_is_no_jump(fly: Fly) -> None:
    vehicle = Double(60, attitude=lambda tick: exp((2.0 * tick * DT, 0.0, 0.0)))
    vehicle.rate = (2.0, 0.0, 0.0)
    assert states(fly(vehicle).log) == [(0.0, "running"), (0.6, "done")]
    vehicle = Double(60, attitude=lambda tick: exp((2.0 * tick * DT, 0.0, 0.0)))
    assert (0.01, "attitude_jump") in states(fly(vehicle).log)


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
