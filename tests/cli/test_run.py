import json
import re
from importlib import import_module
from pathlib import Path

import pytest

from atlas_cueing.recording import read_log

from .conftest import SCRIPT, Command


def test_a_run_for_people(command: Command, tmp_path: Path) -> None:
    ended = command("run", "s.toml")
    assert (ended.status, ended.err) == (0, "")
    assert re.search(r"^result +ok$", ended.out, re.MULTILINE)
    assert re.search(r"^log +short.mcap$", ended.out, re.MULTILINE)
    assert re.search(
        r"^flight +0.45 s, 55 ticks, flown at \d+\.\d times real time$", ended.out, re.MULTILINE
    )
    assert re.search(r"^specific force +m/s2 +\d", ended.out, re.MULTILINE)
    assert re.search(r"^wheel speed +\d+\.\d+ % of its limit$", ended.out, re.MULTILINE)
    assert len(read_log(tmp_path / "short.mcap").column("/motion", "time_s")) == 55
    assert {path.name for path in tmp_path.iterdir()} == {"s.toml", "short.mcap"}


def test_a_run_for_programs(command: Command) -> None:
    ended = command("run", "s.toml", "-o", "other.mcap", "--json")
    assert (ended.status, ended.err) == (0, "")
    table = json.loads(ended.out)
    assert (table["result"], table["reason"], table["log"], table["ticks"]) == (
        "ok",
        "",
        "other.mcap",
        55,
    )
    assert table["duration_s"] == pytest.approx(0.45, abs=1e-6)
    assert table["violations"] == []
    names = {
        "force_rms_m_s2",
        "direction_rms_rad",
        "rate_rms_rad_s",
        "wheels_limited_share",
        "stage_limited_share",
    }
    assert names <= table["metrics"].keys()


def test_an_existing_log_is_kept_without_force(command: Command, tmp_path: Path) -> None:
    (tmp_path / "short.mcap").write_bytes(b"\x89MCAP precious")
    ended = command("run", "s.toml")
    assert (ended.status, ended.out) == (2, "")
    assert "--force" in ended.err
    assert (tmp_path / "short.mcap").read_bytes() == b"\x89MCAP precious"
    assert command("run", "s.toml", "--force").status == 0
    assert read_log(tmp_path / "short.mcap").metadata["result"] == "ok"


def test_settings(command: Command, tmp_path: Path) -> None:
    ended = command(
        "run",
        "s.toml",
        "--set",
        "cueing.method=attitude",
        "--set",
        "duration_s=0.1",
        "--set",
        "name=other",
        "--json",
    )
    assert json.loads(ended.out)["ticks"] == 13
    log = read_log(tmp_path / "other.mcap")
    assert log.metadata["method"] == "attitude"
    assert b'method = "attitude"' in log.attachments["scenario.toml"]


def test_every_mistake_is_a_line_of_its_own(command: Command, tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(
        SCRIPT.replace("c1722", "c1723x").replace("atlas-2.9m", "atlas-3m")
    )
    ended = command("run", "s.toml", "--set", "duration_s=-1", "--json")
    assert (ended.status, ended.out) == (2, "")
    lines = ended.err.splitlines()
    assert len(lines) == 3
    assert all(line.startswith("error: ") for line in lines)
    assert lines[0].startswith("error: --set: duration_s = -1: ")
    assert [path.name for path in tmp_path.iterdir()] == ["s.toml"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["missing.toml"], "missing.toml: file: cannot be read"),
        (["."], "to fly all scenarios in it: atlas-cueing batch . -o RESULTS"),
        (["s.toml", "-o", "no/such/folder.mcap"], "there is no folder"),
        (["s.toml", "-o", ".", "--force"], "no regular file"),
        (["s.toml", "-o", "x" * 300], "File name too long"),
        (["s.toml", "--set", "duration_s"], "KEY=VALUE"),
        (["s.toml", "--set", "vehicle.script=unitconversions"], "unitconversions"),
        (
            [
                "s.toml",
                *(
                    f"--set=platform.wheel.{i}.{key}"
                    for i in (0, 1)
                    for key in ("contact=[1,0,0]", "drive=[0,1,0]")
                ),
            ],
            "kinematic slip condition",
        ),
    ],
    ids=lambda part: str(part)[:30],
)
def test_bad_input_writes_nothing(
    command: Command, tmp_path: Path, arguments: list[str], message: str
) -> None:
    ended = command("run", *arguments)
    assert (ended.status, ended.out) == (2, "")
    assert message in ended.err
    assert "Traceback" not in ended.err
    assert [path.name for path in tmp_path.iterdir()] == ["s.toml"]


def test_a_vehicle_that_fails(command: Command, tmp_path: Path) -> None:
    ended = command(
        "run", "s.toml", "--set", "vehicle.script=cannonball", "--set", "duration_s=600", "--json"
    )
    assert ended.status == 1
    table = json.loads(ended.out)
    assert table["result"] == "vehicle_failed"
    assert table["reason"].startswith("vehicle failed at ")
    assert ended.err == f"vehicle_failed: {table['reason']}\n"
    assert len(read_log(tmp_path / "short.mcap").column("/motion", "time_s")) == table["ticks"]


def test_a_violation_is_a_finding(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        import_module("atlas_cueing.run.evaluate"),
        "violations",
        lambda _: ["wheel_speed_logged = 1.5 of the limit"],
    )
    ended = command("run", "s.toml")
    assert ended.status == 1
    assert ended.err == "wheel_speed_logged = 1.5 of the limit\n"
    assert re.search(r"^violations +1$", ended.out, re.MULTILINE)
