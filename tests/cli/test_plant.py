"""`atlas-cueing plant` as its users see it."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing import read_log
from atlas_cueing.review import RecordedRun, judge, open_run

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


def test_a_page(command: Command, log: Path) -> None:
    ended = command("plant", log.name, "--feedback", "fix", "--html", "page.html", "--json")
    assert ended.status == 0
    assert json.loads(ended.out)["feedback"] == "fix"
    page = log.with_name("page.html").read_text()
    assert "<th>none</th><th>fix</th>" in page
    again = command("plant", log.name, "--html", "page.html")
    assert (again.status, "exists already" in again.err) == (2, True)
    assert command("plant", log.name, "--html", "page.html", "--force").status == 0
    assert "<th></th><th>none</th></tr>" in log.with_name("page.html").read_text()


def test_bad_usage_writes_nothing(command: Command, log: Path) -> None:
    for arguments, message in (
        (["missing.mcap", "-o", "new.mcap"], "no such file"),
        ([log.name, "-o", log.name, "--force"], "is a file that is read"),
        ([log.name, "-o", "s.toml"], "exists already"),
        ([log.name, "--html", log.name, "--force"], "is a file that is read"),
        ([log.name, "-o", "new.mcap", "--html", "new.mcap"], "new.mcap"),
        ([log.name, "--feedback", "optic", "-o", "new.mcap"], "none, odometry, gyro, fix"),
        ([log.name, "--set", "platform.plant.step_s=1", "-o", "new.mcap"], "platform.plant.step_s"),
        ([log.name, "--set", "cueing.method=still", "-o", "new.mcap"], "platform.plant.KEY"),
    ):
        ended = command("plant", *arguments)
        assert ended.status == 2, arguments
        assert message in ended.err, ended.err
    assert not (log.parent / "new.mcap").exists()


@pytest.fixture
def corrected(command: Command, log: Path) -> Path:
    command("plant", log.name, "--feedback", "fix", "-o", "new.mcap")
    return log.with_name("new.mcap")


def altered(log: Path, topic: str, field: str, value: float, row: int = 30) -> RecordedRun:
    """The log's run with another number in a row."""
    run = open_run(log)
    table = run.log.tables[topic]
    values = table.values.copy()
    values[row, table.fields.index(field)] = value
    tables = {**run.log.tables, topic: replace(table, values=values)}
    return replace(run, log=replace(run.log, tables=tables))


@pytest.mark.parametrize(
    ("topic", "field", "value", "told"),
    [
        ("/correction", "w2_rad_s", 40.0, "/wheels + /correction w2_rad_s: limit"),
        ("/correction", "a1_rad_s2", -130.0, "/wheels + /correction a1_rad_s2: limit"),
        ("/correction", "a1_rad_s2", 20.0, "/wheels + /correction a1_rad_s2: jerk"),
        ("/plant", "q_ws_w", 50.0, "/plant q_ws: length"),
        ("/plant", "error_rad", 0.5, "/plant error_rad: error"),
    ],
)
def test_a_review_finds_what_cannot_be(
    corrected: Path, topic: str, field: str, value: float, told: str
) -> None:
    found = judge(altered(corrected, topic, field, value)).findings
    assert told in str(found[0])
    assert all(topic in finding.place for finding in found)
    assert not judge(open_run(corrected)).findings


def test_a_review_says_that_figures_are_of_the_schedule(command: Command, corrected: Path) -> None:
    error = np.degrees(np.abs(read_log(corrected).column("/plant", "error_rad")))
    note = (
        f"figures are of the schedule; the simulated sphere of /plant was up to {error.max():.3g}"
    )
    assert note in command("review", corrected.name).out
    assert f"new: {note}" in command("compare", "short.mcap", corrected.name).err
    assert "schedule" not in command("review", "short.mcap").out


def test_units_and_frames_of_what_it_writes(command: Command, corrected: Path) -> None:
    command("export", corrected.name, "-o", "new.csv")
    lines = corrected.with_name("new.csv").read_text().splitlines()
    for line in (
        "# plant.q_ws_w, 1, S to W",
        "# plant.estimate_ws_w, 1, S to W",
        "# plant.wz_rad_s, rad/s, W",
        "# plant.fx_m_s2, m/s^2, S (FRD)",
    ):
        assert line in lines


def test_a_damaged_log_is_bad_input(command: Command, log: Path) -> None:
    log.write_bytes(log.read_bytes()[:-3000])
    ended = command("plant", log.name, "-o", "new.mcap")
    assert ended.status == 2
    assert "try: atlas-cueing recover short.mcap" in ended.err
