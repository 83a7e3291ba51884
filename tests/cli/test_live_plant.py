"""`live --plant --feedback` as its users see it: real time, real processes, one command."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from atlas_cueing import read_log
from atlas_cueing.review import judge, open_run
from atlas_cueing.rotations import geodesic

from .conftest import Command
from .test_plant import altered

RIDE = ("live", "s.toml", "--rate", "100", "--lead", "80", "--set", "duration_s=3")
HALO = ("--set", "platform.preset=atlas-2.9m-halo", "--set", "cueing.method=blend")
NEW = ("-o", "new.mcap", "--force", "--json")


def ride(command: Command) -> tuple[int, dict[str, Any]]:
    """Exit status and result of a ride; one that a busy machine has made late is flown again."""
    for _ in range(3):
        ended = command(*RIDE, *HALO, "--plant", "--feedback", "fix", *NEW)
        told = json.loads(ended.out)
        if not held_up(told):
            break
    return ended.status, told


def held_up(told: dict[str, Any]) -> bool:
    """Whether the machine had so much else to do that the ride was late."""
    return "too late for" in told["reason"] or "were silent for" in told["reason"]


def test_a_ride_on_a_simulated_platform(command: Command) -> None:
    status, told = ride(command)
    late = held_up(told)
    assert status == late, told
    assert told["violations"] == []
    log = read_log("new.mcap")
    assert {"/plant", "/correction", "/estimate", "/timing"} <= {*log.tables}
    count = len(log.column("/motion", "time_s"))
    for topic in ("/plant", "/correction", "/estimate"):
        assert len(log.column(topic, "time_s")) == count, topic
    plant, drives = told["plant"], told["drives"]
    error = geodesic(log.vector("/plant", "q_ws"), log.vector("/motion", "q_ws"))
    assert np.degrees(error.max()) == pytest.approx(plant["orientation_error_max_deg"])
    away = log.vector("/plant", "f") - log.vector("/felt", "f")
    assert np.sqrt(np.mean(away**2)) < 0.3  # a stop of a late ride is hard
    assert "by its sensors, it was up to" in command("review", "new.mcap").out
    run = altered(Path("new.mcap"), "/estimate", "error_rad", 0.5, count - 10)
    assert "/estimate error_rad: error" in str(judge(run).findings[-1])
    if not late:
        assert drives["fixes"] >= 30
        assert drives["fixes_refused"] == 0
        assert 0.0 < plant["estimate_error_max_deg"] < 0.5
        assert not judge(open_run(Path("new.mcap"))).findings


def test_what_does_not_go_together_is_refused(command: Command) -> None:
    for options, message in (
        (["--feedback", "fix"], "--setpoints HOST:PORT or --plant"),
        (["--plant", "--feedback", "odometry"], "none, gyro, fix"),
        (["--plant", "--setpoints", "127.0.0.1:5600"], "--setpoints is for real drives"),
        (["--plant", "--from", "home"], "--from is for"),
        (["--plant", "--no-drive-status"], "--no-drive-status is for real drives"),
        (["--plant", "--drive-tolerance", "0"], "0.01"),
        (
            ["--setpoints", "127.0.0.1:5600", "--no-drive-status", "--feedback", "gyro"],
            "which --no-drive-status turns off",
        ),
        (["--plant", "--set", "platform.preset=nowhere"], "nowhere"),
    ):
        ended = command("live", "s.toml", "-o", "new.mcap", *options)
        assert ended.status == 2, options
        assert message in ended.err, ended.err
