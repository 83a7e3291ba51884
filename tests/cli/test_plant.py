"""`atlas-cueing plant` as its users see it."""

import json
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing import read_log

from .conftest import Command


@pytest.fixture
def log(command: Command, tmp_path: Path) -> Path:
    assert command("run", "s.toml").status == 0
    return tmp_path / "short.mcap"


def test_a_log_with_what_the_plant_did(command: Command, log: Path) -> None:
    ended = command("plant", log.name, "--feedback", "fix", "-o", "new.mcap", "--json")
    assert (ended.status, ended.err) == (0, "")
    told = json.loads(ended.out)
    for name in ("orientation_error_end_rad", "orientation_error_max_rad", "slip_max_m_s"):
        assert told[name] >= 0.0
    assert abs(told["energy_residual_j"]) <= 1e-6 * told["energy_throughput_j"]
    old, new = read_log(log), read_log(log.with_name("new.mcap"))
    assert {*new.tables} == {*old.tables, "/plant", "/correction"}
    for topic, table in old.tables.items():  # /motion stays the schedule
        assert np.array_equal(table.values, new.tables[topic].values), topic
        assert np.array_equal(table.log_times, new.tables[topic].log_times), topic
    assert new.column("/plant", "error_rad")[-1] == told["orientation_error_end_rad"]
    assert np.array_equal(new.column("/plant", "time_s"), old.column("/motion", "time_s"))
    reviews = [json.loads(command("review", name, "--json").out) for name in (log.name, "new.mcap")]
    assert reviews[0]["verdict"] == reviews[1]["verdict"] == "clean"
    assert reviews[0]["metrics"] == reviews[1]["metrics"]
    assert command("recue", "new.mcap", "-o", "again.mcap").status == 0
    assert command("plant", "new.mcap", "-o", "twice.mcap").status == 0


def test_for_people(command: Command, log: Path) -> None:
    ended = command("plant", log.name)
    assert ended.status == 0
    assert "orientation_error_end_deg" in ended.out
    assert not [*log.parent.glob("*.part")]


def test_bad_usage_writes_nothing(command: Command, log: Path) -> None:
    for arguments, message in (
        (["missing.mcap", "-o", "new.mcap"], "no such file"),
        ([log.name, "-o", log.name, "--force"], "is a file that is read"),
        ([log.name, "-o", "s.toml"], "exists already"),
        ([log.name, "--feedback", "optic", "-o", "new.mcap"], "none, odometry, gyro, fix"),
        ([log.name, "--set", "platform.plant.step_s=1", "-o", "new.mcap"], "platform.plant.step_s"),
        ([log.name, "--set", "cueing.method=still", "-o", "new.mcap"], "platform.plant.KEY"),
    ):
        ended = command("plant", *arguments)
        assert ended.status == 2, arguments
        assert message in ended.err, ended.err
    assert not (log.parent / "new.mcap").exists()
