"""Logs as vehicles."""

from collections.abc import Callable
from dataclasses import replace
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.recording import Log, read_log, read_metadata, write_vehicle_log
from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import RecordedFlight, load_scenario, recorded_vehicle
from atlas_cueing.vehicles import Bounds

from .texts import SCRIPT

RECORDED = """
name = "again"
[vehicle]
source = "recording"
log = "{}"
[platform]
preset = "atlas-2.9m"
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("flown")
    (folder / "s.toml").write_text(SCRIPT)
    run_scenario(load_scenario(folder / "s.toml"), folder / "log.mcap")
    return folder / "log.mcap"


def spoilt(log: Log, field: str, value: float, row: int = 7) -> Log:
    """The log with one number of the vehicle changed."""
    table = log.tables["/vehicle"]
    values = table.values.copy()
    values[row, table.fields.index(field)] = value
    return replace(log, tables={**log.tables, "/vehicle": replace(table, values=values)})


def test_every_state_as_it_was(path: Path) -> None:
    vehicle = RecordedFlight(path).vehicle()
    log = read_log(path)
    states = [vehicle.state]
    while vehicle.advance():
        states.append(vehicle.state)
    assert np.array_equal([state.q_NB for state in states], log.vector("/vehicle", "q_nb"))
    assert np.array_equal([state.f_B for state in states], log.vector("/vehicle", "f"))
    assert np.array_equal([state.time for state in states], log.column("/vehicle", "time_s"))


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("fz_m_s2", nan, "specific force nan"),
        ("fx_m_s2", 1e6, "specific force 1e\\+06 m/s\\^2, allowed"),
        ("wx_rad_s", inf, "body rate inf"),
        ("q_nb_w", nan, "attitude of norm nan, allowed: 1 within 1e-06"),
        ("q_nb_y", 0.9, "attitude of norm"),
        ("time_s", inf, "time is not finite"),
    ],
)
def test_what_is_not_believable_is_refused(
    path: Path, field: str, value: float, message: str
) -> None:
    log = spoilt(read_log(path), field, value)
    with pytest.raises(InputError, match=message):
        recorded_vehicle(log, Bounds())


def test_without_bounds_states_are_taken_as_they_are(path: Path) -> None:
    """As recue does, where what was recorded is evidence."""
    vehicle = recorded_vehicle(spoilt(read_log(path), "fz_m_s2", nan, row=0))
    assert vehicle.state.f_B[2] != vehicle.state.f_B[2]


def test_no_log_at_all(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        RecordedFlight(tmp_path / "none.mcap").vehicle()
    with pytest.raises(InputError, match="not a regular file"):
        RecordedFlight(tmp_path).vehicle()
    (tmp_path / "junk.mcap").write_bytes(b"\x89MCAP0\r\n" + bytes(100))
    with pytest.raises(InputError, match=r"junk\.mcap"):
        RecordedFlight(tmp_path / "junk.mcap").vehicle()


def changed(log: Log, folder: Path, change: Callable[[np.ndarray], np.ndarray]) -> RecordedFlight:
    """The flight of the log alone, its rows changed, in a file of its own."""
    rows = change(log.tables["/vehicle"].values.copy())
    (folder / "changed.mcap").write_bytes(write_vehicle_log(rows, {}, {}))
    return RecordedFlight(folder / "changed.mcap")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda rows: np.delete(rows, 7, axis=0), "1 state missing between 0.05"),
        (lambda rows: np.delete(rows, np.s_[5:9], axis=0), "4 states missing between"),
        (lambda rows: rows + 1e-3 * np.eye(len(rows), 11, -9) * np.eye(11)[0], "no equal steps"),
        (lambda rows: rows[:1], "has 1 states, allowed: at least 2"),
        (lambda rows: rows[:0], "has no /vehicle|has 0 states"),
        (lambda rows: rows[[0, 1, 1, 2]], "must go on in time"),
    ],
    ids=["one", "four", "jitter", "single", "none", "twice"],
)
def test_what_is_no_even_flight_is_refused(
    path: Path, tmp_path: Path, change: Callable[[np.ndarray], np.ndarray], message: str
) -> None:
    flight = changed(read_log(path), tmp_path, change)
    (tmp_path / "s.toml").write_text(RECORDED.format("changed.mcap"))
    for attempt in (
        flight.step,
        lambda: run_scenario(load_scenario(tmp_path / "s.toml"), tmp_path / "new.mcap"),
    ):
        with pytest.raises(InputError, match=message) as caught:
            attempt()
        assert "changed" in str(caught.value)
    assert not (tmp_path / "new.mcap").exists()


def test_a_foreign_start_and_sign_are_put_right(path: Path, tmp_path: Path) -> None:
    """Time begins at 0 and quaternions do not flip, whoever wrote them."""

    def foreign(rows: np.ndarray) -> np.ndarray:
        rows[:, 0] += 100.0
        rows[9:, 1:5] *= -1.0
        return rows

    vehicle = changed(read_log(path), tmp_path, foreign).vehicle()
    before = vehicle.state
    assert before.time == 0.0
    while vehicle.advance():
        assert np.dot(before.q_NB, vehicle.state.q_NB) > 0.9
        before = vehicle.state


def test_a_recording_flies_as_it_did(path: Path, tmp_path: Path) -> None:
    """The same states give the same bytes of everything that follows, also for a part of it."""
    log = read_log(path)
    (tmp_path / "log.mcap").write_bytes(path.read_bytes())
    (tmp_path / "s.toml").write_text(RECORDED.format("log.mcap"))
    scenario = load_scenario(tmp_path / "s.toml")
    assert scenario.flight.length() == log.column("/vehicle", "time_s")[-1]
    assert scenario.inputs() == (tmp_path / "log.mcap",)
    run_scenario(scenario, tmp_path / "again.mcap")
    again = read_log(tmp_path / "again.mcap")
    for topic, table in log.tables.items():
        assert np.array_equal(table.values, again.tables[topic].values), topic
    short = load_scenario(tmp_path / "s.toml", ["duration_s=0.2", "cueing.method=attitude"])
    assert run_scenario(short, tmp_path / "short.mcap").duration == pytest.approx(0.2, abs=0.01)


def test_a_run_reads_its_recording_once(
    path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read: list[Path] = []

    def counted(log: Path, most: int) -> Log:
        read.append(log)
        return read_log(log, most)

    monkeypatch.setattr("atlas_cueing.scenario.recorded.read_log", counted)
    (tmp_path / "again.toml").write_text(RECORDED.format(path))
    run_scenario(load_scenario(tmp_path / "again.toml"), tmp_path / "new.mcap")
    assert read == [path]
    assert read_metadata(path) == read_log(path).metadata
