"""`atlas-cueing recue` as its users see it."""

import json
import re
from pathlib import Path

import pytest

from .conftest import Command


@pytest.fixture
def log(command: Command, tmp_path: Path) -> Path:
    assert command("run", "s.toml").status == 0
    return tmp_path / "short.mcap"


def test_for_people(command: Command, log: Path) -> None:
    ended = command("recue", log.name, "--set", "cueing.method=attitude", "-o", "new.mcap")
    assert (ended.status, ended.err) == (0, "")
    assert re.search(r"^scenario +short, attitude on atlas-2.9m$", ended.out, re.MULTILINE)
    assert command("compare", log.name, "new.mcap").status == 0


def test_without_settings_nothing_changes(command: Command, log: Path) -> None:
    ended = command("recue", log.name, "-o", "new.mcap", "--json")
    table, old = json.loads(ended.out), json.loads(command("review", log.name, "--json").out)
    assert table["metrics"] == old["metrics"]
    assert table["metadata"]["recued_from"] == "short.mcap"


@pytest.mark.usefixtures("log")
def test_bad_usage_writes_nothing(command: Command, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("time_s,fx\n0,1\n")
    (tmp_path / "cut.mcap").write_bytes((tmp_path / "short.mcap").read_bytes()[:-3000])
    for arguments, message in (
        (["missing.mcap", "-o", "new.mcap"], "no such file"),
        (["a.csv", "-o", "new.mcap"], "a.csv: this is no MCAP file"),
        (["cut.mcap", "-o", "new.mcap"], "atlas-cueing recover cut.mcap"),
        (["short.mcap", "-o", "short.mcap", "--force"], "is a file that is read"),
        (["short.mcap", "-o", "s.toml"], "exists already"),
        (
            ["short.mcap", "-o", "new.mcap", "--set", "vehicle.script=c1723"],
            "the flight is the recorded one",
        ),
        (
            [
                "short.mcap",
                "-o",
                "new.mcap",
                "--set",
                "cueing.method=x",
                "--set",
                "platform.preset=y",
            ],
            "--set: cueing.method",
        ),
    ):
        ended = command("recue", *arguments)
        assert (ended.status, ended.out) == (2, "")
        assert message in ended.err
        assert "Traceback" not in ended.err
    assert {path.name for path in tmp_path.iterdir()} == {
        "s.toml",
        "short.mcap",
        "a.csv",
        "cut.mcap",
    }


def test_every_mistake_is_a_line_of_its_own(command: Command, log: Path) -> None:
    ended = command(
        "recue",
        log.name,
        "-o",
        "new.mcap",
        "--set",
        "cueing.method=x",
        "--set",
        "platform.preset=y",
    )
    lines = ended.err.splitlines()
    assert len(lines) == 2
    assert all(line.startswith("error: --set: ") for line in lines)


def test_a_finding(command: Command, log: Path) -> None:
    """A vehicle that failed is a finding of the recued log as well."""
    command(
        "run", "s.toml", "--force", "--set", "vehicle.script=cannonball", "--set", "duration_s=600"
    )
    ended = command("recue", log.name, "-o", "new.mcap")
    assert ended.status == 1
    assert "vehicle_failed" in ended.out
