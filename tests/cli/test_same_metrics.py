"""`review --json` tells of a log what the run that wrote it told, every metric to the last bit."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import Command

PROGRAM = Path(sys.executable).with_name("atlas-cueing")
LIVE = """
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
"""


def check_same(run: str, review: str) -> dict[str, object]:
    """All metrics, their names in the same order; gives what the run told."""
    told, found = json.loads(run), json.loads(review)
    assert list(told["metrics"]) == list(found["metrics"])
    # which writes every bit, and NaN
    assert json.dumps(told["metrics"]) == json.dumps(found["metrics"])
    assert len(told["metrics"]) > 110
    assert told["ticks"] == found["ticks"]
    return dict(told)


@pytest.mark.parametrize(
    "settings",
    [
        (),
        ("cueing.method=attitude",),
        ("cueing.method=classical", "platform.preset=atlas-orthogonal"),
        ("duration_s=0.0001",),
    ],
    ids=["blend", "attitude", "classical", "one tick"],
)
def test_a_run(command: Command, settings: tuple[str, ...]) -> None:
    ran = command(
        "run", "s.toml", "--json", *(word for setting in settings for word in ("--set", setting))
    )
    assert ran.status == 0
    check_same(ran.out, command("review", "short.mcap", "--json").out)


def test_a_vehicle_that_fails(command: Command) -> None:
    ran = command(
        "run", "s.toml", "--json", "--set", "vehicle.script=cannonball", "--set", "duration_s=600"
    )
    told = check_same(ran.out, command("review", "short.mcap", "--json").out)
    assert (ran.status, told["result"]) == (1, "vehicle_failed")


def test_a_live_run(command: Command, tmp_path: Path) -> None:
    """In a process of its own, since it forks.

    A machine too busy for it may make a fault of the run.
    """
    (tmp_path / "s.toml").write_text(LIVE)
    words = [
        PROGRAM,
        "live",
        "s.toml",
        "-o",
        "l.mcap",
        "--rate",
        "100",
        "--duration",
        "0.5",
        "--json",
    ]
    ran = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode in (0, 1), ran.stderr
    check_same(ran.stdout, command("review", "l.mcap", "--json").out)
