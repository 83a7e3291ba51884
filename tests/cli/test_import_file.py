"""`atlas-cueing import` as its users see it: from a file of others to a clean review."""

import json
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from flight_data import recorders
from flight_data.truth import Truth, plain_csv, truth

from atlas_cueing.recording import read_log

from .conftest import Command

FLOWN = truth(np.arange(300) / 100.0, 1.0)
RECORDED = """
name = "again"
[vehicle]
source = "recording"
log = "flight.mcap"
[platform]
preset = "atlas-2.9m"
"""
FILES: dict[str, tuple[str, Callable[[Path, Truth], Path]]] = {
    "drive.csv": ("csv", plain_csv),
    "a.ulg": ("px4", recorders.ulog),
    "a.bin": ("ardupilot", recorders.dataflash),
    "mcap_bag": ("ros-imu", lambda path, flown: recorders.ros_bag(path, flown, "MCAP")),
    "db3_bag": ("ros-imu", lambda path, flown: recorders.ros_bag(path, flown, "SQLITE3")),
}


@pytest.mark.parametrize("name", FILES)
def test_from_the_file_to_a_clean_run(command: Command, tmp_path: Path, name: str) -> None:
    map_name, write = FILES[name]
    write(tmp_path / name, FLOWN)
    ended = command("import", name, "-o", "flight.mcap", "--map", map_name)
    assert (ended.status, ended.err) == (0, "")
    assert f"origin    {name}" in ended.out
    assert command("review", "flight.mcap").status == 0
    (tmp_path / "again.toml").write_text(RECORDED)
    assert command("run", "again.toml").status == 0
    assert command("review", "again.mcap").status == 0
    cued = command("recue", "flight.mcap", "--set", "platform.preset=atlas-1.5m", "-o", "c.mcap")
    assert cued.status == 0
    told = read_log(tmp_path / "flight.mcap").metadata
    assert (told["origin"], told["map"], told["attitude"]) == (name, map_name, "measured")
    refused = command("run", "again.toml", "-o", "flight.mcap", "--force")
    assert (refused.status, "is a file that is read" in refused.err) == (2, True)


def test_what_a_damaged_file_has_is_written_with_a_finding(
    command: Command, tmp_path: Path
) -> None:
    whole = recorders.dataflash(tmp_path / "a.bin", FLOWN).read_bytes()
    begin = whole.index(b"\xa3\x95", len(whole) // 2)
    (tmp_path / "a.bin").write_bytes(whole[: begin + 2] + b"\xc2" + whole[begin + 3 :])
    ended = command("import", "a.bin", "-o", "a.mcap", "--map", "ardupilot", "--json")
    table = json.loads(ended.out)
    assert (ended.status, table["result"]) == (1, "damaged")
    assert ended.err == f"a.bin: {table['notes'][0]}\n"
    assert "the file is damaged, unknown msg type" in ended.err
    assert command("review", "a.mcap").status == 0
    again = command("import", "a.bin", "-o", "b.mcap", "--map", "ardupilot")
    assert (again.status, "note      the file is damaged" in again.out) == (1, True)


def test_split_flights_are_numbered(command: Command, tmp_path: Path) -> None:
    lines = plain_csv(tmp_path / "a.csv", truth(np.arange(600) / 100.0)).read_text().splitlines()
    del lines[250:290]
    (tmp_path / "a.csv").write_text("\n".join(lines))
    refused = command("import", "a.csv", "-o", "f.mcap", "--map", "csv")
    assert (refused.status, refused.out) == (2, "")
    assert "error: a.csv: force: nothing from 2.480000 to 2.890000 s" in refused.err
    assert "--split makes a flight of each piece" in refused.err
    ended = command("import", "a.csv", "-o", "f.mcap", "--map", "csv", "--split", "--json")
    table = json.loads(ended.out)
    assert [flight["log"] for flight in table["flights"]] == ["f_1.mcap", "f_2.mcap"]
    assert [flight["begin_s"] for flight in table["flights"]] == [0.0, 2.89]
    assert (tmp_path / "f_2.mcap").exists()
    assert command("import", "a.csv", "-o", "f.mcap", "--map", "csv", "--split").status == 2


def test_bad_usage_writes_nothing(command: Command, tmp_path: Path) -> None:
    plain_csv(tmp_path / "a.csv", FLOWN)
    (tmp_path / "my.toml").write_text("format = 1")
    for arguments, message in (
        ([], "allowed: atlas-cueing import FILE -o FLIGHT.mcap --map"),
        (["a.csv", "-o", "f.mcap"], "--list-maps"),
        (["a.csv", "-o", "f.mcap", "--map", "cvs"], "did you mean 'csv'"),
        (["a.csv", "-o", "f.mcap", "--map", "my.toml"], "my.toml: format = 1"),
        (["b.csv", "-o", "f.mcap", "--map", "csv"], "no such file"),
        (["a.csv", "-o", "a.csv", "--map", "csv", "--force"], "is a file that is read"),
        (["a.csv", "-o", "s.toml", "--map", "csv", "--force"], "nothing else is replaced"),
        (["a.csv", "-o", "f.mcap", "--map", "px4"], "is no ULog"),
        (["a.csv", "-o", "f.mcap", "--map", "ardupilot"], "is no DataFlash log"),
        (["a.csv", "-o", "f.mcap", "--map", "ros-imu"], "no ROS bag that can be read"),
    ):
        ended = command("import", *arguments)
        assert (ended.status, ended.out) == (2, ""), arguments
        assert message in ended.err
        assert "Traceback" not in ended.err
    assert {path.name for path in tmp_path.iterdir()} == {"s.toml", "a.csv", "my.toml"}


def test_a_map_of_ones_own_and_the_list(command: Command, tmp_path: Path) -> None:
    listed = command("import", "--list-maps")
    assert listed.status == 0
    (csv_map,) = [line.strip() for line in listed.out.splitlines() if line.endswith("/csv.toml")]
    (tmp_path / "mine.toml").write_text(Path(csv_map).read_text().replace('"fx"', '"forward"'))
    path = plain_csv(tmp_path / "a.csv", FLOWN)
    path.write_text(path.read_text().replace("fx", "forward", 1))
    assert command("import", "a.csv", "-o", "f.mcap", "--map", "mine.toml").status == 0
    log = read_log(tmp_path / "f.mcap")
    assert np.array_equal(log.vector("/vehicle", "f"), FLOWN.f_B)
    assert b"forward" in log.attachments["map.toml"]


@pytest.mark.parametrize(
    ("package", "name"), [("rosbags", "x.mcap"), ("pyulog", "a.ulg"), ("pymavlink", "a.bin")]
)
def test_a_missing_decoder_names_the_extra(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, package: str, name: str
) -> None:
    map_name = {"rosbags": "ros-imu", "pyulog": "px4", "pymavlink": "ardupilot"}[package]
    (tmp_path / name).write_bytes(b"x")
    for module in [m for m in sys.modules if m.split(".")[0] == package]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, package, None)
    ended = command("import", name, "-o", "f.mcap", "--map", map_name)
    assert ended.status == 2
    assert "pip install 'atlas_cueing[logs]'" in ended.err


def test_maps_for_programs(command: Command) -> None:
    maps = json.loads(command("import", "--list-maps", "--json").out)["maps"]
    (csv_map,) = [each for each in maps if each["name"] == "csv"]
    assert csv_map["format"] == "csv"
    assert Path(csv_map["file"]).is_file()


def test_an_attitude_that_was_made_is_marked_in_every_ride(
    command: Command, tmp_path: Path
) -> None:
    lines = plain_csv(tmp_path / "a.csv", FLOWN).read_text().splitlines()
    (tmp_path / "a.csv").write_text("\n".join(",".join(line.split(",")[:7]) for line in lines))
    assert command("import", "a.csv", "-o", "flight.mcap", "--map", "csv").status == 0
    (tmp_path / "again.toml").write_text(RECORDED)
    assert command("run", "again.toml").status == 0
    words = ("--set", "platform.preset=atlas-2.9m", "-o", "cued.mcap")
    assert command("recue", "flight.mcap", *words).status == 0
    assert command("recue", "again.mcap", "-o", "twice.mcap").status == 0
    for log in ("again.mcap", "cued.mcap", "twice.mcap"):
        told = read_log(tmp_path / log).metadata
        assert told["attitude"].startswith("complementary filter of 10 s"), log
        assert told["origin"] == "a.csv"
        reviewed = command("review", log)
        assert reviewed.status == 0
        assert "the vehicle's attitude was not measured: complementary filter" in reviewed.out
    assert command("run", "s.toml").status == 0
    assert "attitude" not in read_log(tmp_path / "short.mcap").metadata


@pytest.mark.parametrize(
    ("signs", "doubted"), [((1.0, 1.0, 1.0), False), ((1.0, -1.0, -1.0), True)]
)
def test_a_sensor_upside_down_is_suspected(
    command: Command, tmp_path: Path, signs: tuple[float, float, float], doubted: bool
) -> None:
    turned = np.array(signs)
    rows = np.column_stack([FLOWN.time, FLOWN.f_B * turned, FLOWN.w_B * turned])
    lines = ["time_s,fx,fy,fz,wx,wy,wz", *(",".join(map(repr, row)) for row in rows.tolist())]
    (tmp_path / "a.csv").write_text("\n".join(lines))
    ended = command("import", "a.csv", "-o", "f.mcap", "--map", "csv")
    assert ended.status == 0
    assert ("or is the sensor mounted another way?" in ended.out) == doubted
