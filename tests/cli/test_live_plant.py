"""`live --plant --feedback` as its users see it: real time, real processes, one command."""

import json

import numpy as np
import pytest

from atlas_cueing import read_log
from atlas_cueing.rotations import geodesic

from .conftest import Command

RIDE = ("live", "s.toml", "--rate", "100", "--lead", "80", "--set", "duration_s=3")
HALO = ("--set", "platform.preset=atlas-2.9m-halo", "--set", "cueing.method=blend")


def test_a_ride_on_a_simulated_platform(command: Command) -> None:
    ended = command(*RIDE, *HALO, "--plant", "--feedback", "fix", "-o", "new.mcap", "--json")
    told = json.loads(ended.out)
    late = "too late for the drives" in told["reason"]  # a machine with much else to do
    assert ended.status == 0 or late, ended.out
    assert told["violations"] == []
    plant, drives = told["plant"], told["drives"]
    assert drives["fixes"] >= 30
    assert drives["fixes_refused"] == 0
    assert 0.0 < plant["estimate_error_max_deg"] < 0.5
    log = read_log("new.mcap")
    assert {"/plant", "/correction", "/estimate", "/timing"} <= {*log.tables}
    count = len(log.column("/motion", "time_s"))
    for topic in ("/plant", "/correction", "/estimate"):
        assert len(log.column(topic, "time_s")) == count, topic
    error = geodesic(log.vector("/plant", "q_ws"), log.vector("/motion", "q_ws"))
    assert np.degrees(error.max()) == pytest.approx(plant["orientation_error_max_deg"])
    away = log.vector("/plant", "f") - log.vector("/felt", "f")
    assert np.sqrt(np.mean(away**2)) < 0.3  # a stop of a late ride is hard
    review = command("review", "new.mcap", "--json")
    assert json.loads(review.out)["findings"] == [] or late, review.out
    assert "plant" in command("review", "new.mcap").out


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
