"""Logs as vehicles."""

from dataclasses import replace
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.errors import InputError, LogError
from atlas_cueing.recording import Log, read_log
from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import RecordedFlight, load_scenario, recorded_vehicle
from atlas_cueing.vehicles import Bounds

from .texts import SCRIPT


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
    with pytest.raises(LogError):
        RecordedFlight(tmp_path / "junk.mcap").vehicle()
