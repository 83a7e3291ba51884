"""The command, in a process of its own.

A machine too busy for 100 Hz may make a fault of a run: then the exit status is 1.
"""

import json
import signal
import socket
import subprocess
import sys
from contextlib import suppress
from math import inf
from pathlib import Path

import pytest
from waiting import until

from atlas_cueing.live.output.setpoint import decode
from atlas_cueing.recording import read_log

from .conftest import Command

PROGRAM = Path(sys.executable).with_name("atlas-cueing")
SCENARIO = """
name = "short"
duration_s = 60.0
[vehicle]
source = "signal"
[[vehicle.signal]]
axis = "roll_rate"
shape = "sine"
amplitude_deg_s = 10.0
frequency_rad_s = 2.0
duration_s = 60.0
[platform]
preset = "atlas-2.9m"
[cueing]
method = "classical"
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "s.toml").write_text(SCENARIO)
    return tmp_path


def started(folder: Path, *arguments: str) -> subprocess.Popen[str]:
    """The command, once its loop runs: handlers of signals come before the log, ticks after it."""
    command = [PROGRAM, "live", "s.toml", "-o", "l.mcap", "--rate", "100", *arguments]
    process = subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    part = folder / "l.mcap.part"
    until(lambda: process.poll() is not None or part.exists(), 60.0)
    assert process.poll() is None, process.communicate()
    begun = size(part)
    until(lambda: size(part) > begun)
    return process


def size(part: Path) -> float:
    """Of a log that is being written; a finished one is no .part any more."""
    with suppress(FileNotFoundError):
        return part.stat().st_size
    return inf


def states(drives: socket.socket) -> set[str]:
    """Of the platform, in all set points that have come."""
    found = set()
    with suppress(BlockingIOError):
        while True:
            found.add(decode(drives.recv(2048)).state)
    return found


def test_help_tells_what_it_is(command: Command) -> None:
    ended = command("live", "--help")
    assert ended.status == 0
    assert "--setpoints" in ended.out
    assert "not a safety device" in " ".join(ended.out.split())


@pytest.mark.parametrize("rate", ["99", "1001", "nan"])
def test_a_rate_out_of_range(command: Command, rate: str) -> None:
    ended = command("live", "s.toml", "--rate", rate)
    assert ended.status == 2
    assert "allowed: 100 <= rate <= 1000" in ended.err
    assert not list(Path().glob("*.mcap*"))


@pytest.mark.parametrize("option", ["--port", "--foxglove"])
@pytest.mark.parametrize("port", ["-1", "65536", "x"])
def test_a_port_that_is_none(command: Command, option: str, port: str) -> None:
    ended = command("live", "s.toml", option, port)
    assert (ended.status, ended.out) == (2, "")
    assert f"Invalid value for '{option}'" in ended.err


def test_waiting_without_a_view_has_nobody_to_wait_for(command: Command) -> None:
    ended = command("live", "s.toml", "--wait")
    assert (ended.status, ended.out) == (2, "")
    assert "--wait needs --view" in ended.err


@pytest.mark.parametrize("option", ["--pose", "--from", "--no-drive-status"])
def test_what_belongs_to_set_points_needs_them(command: Command, option: str) -> None:
    value = () if option == "--no-drive-status" else ("x.json",)
    ended = command("live", "s.toml", option, *value)
    assert (ended.status, ended.out) == (2, "")
    assert f"{option} is for --setpoints HOST:PORT, which is missing" in ended.err


def test_a_pose_that_is_not_home_is_refused_and_nothing_is_written(command: Command) -> None:
    """It says what to do; without set points nobody asks."""
    pose = '{"version": 1, "platform": "atlas-2.9m", "moving": false, "q_ws": [0, 1, 0, 0],'
    Path("pose.json").write_text(f'{pose} "wheel_angle_rad": [1, 2, 3], "stage_m": [0, 0, 0]}}')
    before = set(Path().iterdir())
    ended = command("live", "s.toml", "--setpoints", "127.0.0.1:5600", "--pose", "pose.json")
    assert (ended.status, ended.out) == (2, "")
    assert "180.0 deg from upright, 0 mm from the centre" in ended.err
    assert "--from pose.json" in ended.err
    assert "--from home" in ended.err
    assert set(Path().iterdir()) == before


def test_an_existing_log_is_kept(command: Command) -> None:
    Path("short.mcap").write_bytes(b"mine")
    ended = command("live", "s.toml")
    assert ended.status == 2
    assert "short.mcap" in ended.err
    assert Path("short.mcap").read_bytes() == b"mine"


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_parks_and_finishes_the_log(folder: Path, number: signal.Signals) -> None:
    process = started(folder, "--json")
    process.send_signal(number)
    out, err = process.communicate(timeout=60.0)
    result = json.loads(out)
    assert "Traceback" not in err
    states = [status.state for status in read_log(folder / "l.mcap").statuses]
    if result["result"] == "ok":
        assert process.returncode == 0
        assert states[-1] == "parked"
    else:
        assert (result["result"], states[-1]) == ("fault", "stopped")
        assert process.returncode == 1, "a fault, before the signal perhaps"


def test_a_second_signal_stops_and_the_log_is_whole(folder: Path) -> None:
    """The second comes when the first has begun to park the platform, which takes a while."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as drives:
        drives.bind(("127.0.0.1", 0))
        drives.setblocking(False)
        process = started(
            folder,
            "--json",
            "--setpoints",
            f"127.0.0.1:{drives.getsockname()[1]}",
            "--no-drive-status",
            "--pose",
            "pose.json",
        )
        for state in ("running", "parking"):
            until(
                lambda awaited=state: process.poll() is not None or awaited in states(drives), 60.0
            )
            process.send_signal(signal.SIGTERM)
    out, err = process.communicate(timeout=60.0)
    assert "Traceback" not in err
    result = json.loads(out)
    assert result["result"] in ("stopped", "fault")
    assert process.returncode == 1
    log = read_log(folder / "l.mcap")
    assert log.metadata["result"] == result["result"]
    assert log.statuses[-1].state == "stopped"
    assert len(log.column("/motion", "time_s")) == result["ticks"]


LATE = """
import atexit, os, signal, sys
from atlas_cueing.cli import live_ride, main, summary

def late(*_):
    os.kill(os.getpid(), signal.SIGTERM)
    os.kill(os.getpid(), signal.SIGHUP)
    os.kill(os.getpid(), signal.SIGINT)

told = summary.run_summary
summary.run_summary = lambda result: (late(), told(result))[1]
atexit.register(late)
status = main()
late()
sys.exit(status)
"""


def test_signals_after_the_end_do_not_change_the_result(folder: Path) -> None:
    """While the result is printed, after it, and when the interpreter ends."""
    arguments = ["live", "s.toml", "-o", "l.mcap", "--rate", "100", "--duration", "0.1"]
    ended = subprocess.run(
        [sys.executable, "-c", LATE, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=120.0,
        check=False,
    )
    assert (ended.returncode, "Traceback" in ended.stderr) == (0, False), ended.stderr
    assert read_log(folder / "l.mcap").metadata["result"] == "ok"


@pytest.mark.parametrize(
    ("options", "error"),
    [
        (("--setpoints", "foo"), "--setpoints foo: the port or the host is missing"),
        (("--setpoints", "127.0.0.1:5600", "--key", "none"), "--key none: "),
        (("--rate", "5"), "--rate 5 Hz, allowed"),
        (("--setpoints", "127.0.0.1:5600", "--from", "none"), "--from none: "),
        (("--foxglove", "PORT"), "in use"),
        (("--view", "--port", "PORT"), "in use"),
    ],
)
def test_an_error_comes_first_and_alone(
    command: Command, options: tuple[str, ...], error: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(Path("state").absolute()))
    before = set(Path().iterdir())
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        ended = command("live", "s.toml", *(port if o == "PORT" else o for o in options))
    assert (ended.status, ended.out) == (2, "")
    assert error in ended.err
    assert ended.err.startswith("error: ")
    assert len(ended.err.splitlines()) == 1, ended.err
    assert set(Path().iterdir()) == before
