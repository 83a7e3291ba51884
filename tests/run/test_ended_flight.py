"""How flights end: by a failure, a signal, an error, a full disk."""

import signal
from collections.abc import Callable
from math import radians
from pathlib import Path

import pytest
from short_scenario import Load

from atlas_cueing.errors import OutputError, VehicleError
from atlas_cueing.recording import McapRecorder, read_log
from atlas_cueing.rotation import exp
from atlas_cueing.run import RunResult, run_scenario
from atlas_cueing.run import fly as run_module
from atlas_cueing.signals import Tick

from .doubles import DT, Double, raising, states

Fly = Callable[[Double], RunResult]


@pytest.fixture
def fly(load: Load, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Fly:
    """Run the scenario with a double in the place of JSBSim."""

    def run(vehicle: Double) -> RunResult:
        monkeypatch.setattr(run_module, "open_vehicle", lambda _: vehicle)
        return run_scenario(load(), tmp_path / "log.mcap")

    return run


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
