"""`atlas-cueing compare` as its users see it."""

import json
import re
from pathlib import Path

import pytest

from .conftest import Command


@pytest.fixture
def logs(command: Command) -> tuple[str, str]:
    """The same flight by two methods."""
    command("run", "s.toml", "-o", "hedge.mcap")
    command("run", "s.toml", "-o", "attitude.mcap", "--set", "cueing.method=attitude")
    return "hedge.mcap", "attitude.mcap"


def test_for_people(command: Command, logs: tuple[str, str]) -> None:
    ended = command("compare", *logs)
    assert (ended.status, ended.err) == (0, "")
    lines = ended.out.splitlines()
    assert lines[0].split() == ["hedge", "attitude"]
    assert lines[1].split() == ["verdict", "clean", "clean"]
    assert (
        re.fullmatch(r"direction rms deg +\d+\.\d{3} +\d+\.\d{3}", lines[5])
        or "direction rms deg" in ended.out
    )
    assert len({len(line) for line in lines}) == 1


def test_for_programs(command: Command, logs: tuple[str, str]) -> None:
    table = json.loads(command("compare", *logs, "--json").out)
    assert table["names"] == ["hedge", "attitude"]
    assert table["metrics"]["ticks"] == [55.0, 55.0]
    assert [log["verdict"] for log in table["logs"]] == ["clean", "clean"]


def test_other_flights_only_when_told(command: Command, logs: tuple[str, str]) -> None:
    command("run", "s.toml", "-o", "other.mcap", "--set", "vehicle.script=c1723")
    ended = command("compare", logs[0], "other.mcap")
    assert (ended.status, ended.out) == (2, "")
    assert ended.err.startswith("error: other.mcap is another flight than hedge.mcap: ")
    assert "--different-flights" in ended.err
    assert command("compare", logs[0], "other.mcap", "--different-flights").status == 0


def test_bad_usage(command: Command, logs: tuple[str, str], tmp_path: Path) -> None:
    assert command("compare", logs[0]).status == 2
    assert command("compare", logs[0], "missing.mcap").status == 2
    (tmp_path / "text.mcap").write_text("no log")
    assert command("compare", logs[0], "text.mcap").status == 1


def test_a_log_given_again_is_compared_once(
    command: Command, logs: tuple[str, str], tmp_path: Path
) -> None:
    (tmp_path / "link.mcap").symlink_to("hedge.mcap")
    ended = command("compare", *logs, logs[0], "link.mcap")
    assert ended.out == command("compare", *logs).out
    assert ended.err.splitlines() == [
        "hedge.mcap is given twice; it is compared once",
        "link.mcap is given twice, also as hedge.mcap; it is compared once",
    ]
    ended = command("compare", logs[0], logs[0])
    assert ended.status == 2
    assert "compare needs at least two logs; got 1" in ended.err


def test_findings_are_told(command: Command, logs: tuple[str, str]) -> None:
    command(
        "run",
        "s.toml",
        "-o",
        "failed.mcap",
        "--set",
        "vehicle.script=cannonball",
        "--set",
        "duration_s=600",
    )
    ended = command("compare", logs[0], "failed.mcap", "--different-flights")
    assert ended.status == 1
    assert "result = 'vehicle_failed'" in ended.err
