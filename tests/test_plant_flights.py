"""The sweep of flights on the simulated platform: its summary by hand, and the tool itself."""

import csv
import json
import subprocess
import sys
from math import degrees, radians
from pathlib import Path

import pytest
from installed import PRESETS, ROOT
from rides.flying import Kept
from rides.on_plant import COLUMNS, PlantOrder, fly_on_plant, summary, table

PRESET = "platform.preset=atlas-2.9m-halo"


@pytest.fixture
def short(tmp_path: Path) -> Path:
    """A flight of half a second."""
    path = tmp_path / "short.toml"
    path.write_text('name = "short"\nduration_s = 0.5\n[vehicle]\nscript = "rudder_kick"\n'
                    '[platform]\npreset = "atlas-2.9m"\n')  # fmt: skip
    return path


def row(flight: str, kind: tuple, end: float, largest: float) -> tuple:
    return (flight, "blend", *kind, radians(end), radians(largest), 0.2, -3e-6, 30.0)


def test_the_summary() -> None:
    """Three flights: held, held worse than by the open loop, and held better but not well."""
    opened, closed = ("none", None), ("fix", 0.05)
    ends = {"a": (0.3, 0.4), "b": (0.05, 1.2), "c": (5.0, 9.0)}
    held = {"a": (0.02, 0.5), "b": (0.04, 1.4), "c": (0.2, 2.0)}
    rows = [row(name, opened, *ends[name]) for name in ends]
    rows += [row(name, closed, *held[name]) for name in held]
    heads, _, first, second = [line.strip("| ").split(" | ") for line in summary(rows)]
    assert dict(zip(heads[:2], first[:2], strict=True)) == {"method": "blend", "feedback": "none"}
    assert first[2:] == ["3", "0.300", "5.000", "2", "1.200", "9.00", "2", "0", "0.20", "1e-07"]
    assert second[1:] == [
        *("fix, 50 ms", "3", "0.040", "0.200", "1"),
        *("1.400", "2.00", "2", "1", "0.20", "1e-07"),
    ]


def test_each_kind_is_kept_apart(short: Path, tmp_path: Path) -> None:
    kept = Kept(tmp_path / "rides")
    orders = [
        PlantOrder(short, (PRESET,), method, kind)
        for method in ("blend", "hedge")
        for kind in (("none", None), ("fix", 0.0), ("fix", 0.05))
    ]
    for k, order in enumerate(orders):
        assert kept.get(order) is None
        kept.put(order, {"k": k})
    assert [kept.get(order) for order in orders] == [{"k": k} for k in range(6)]
    assert orders[2].words == "short, blend: fix, 50 ms"


def test_a_platform_without_masses_is_refused(short: Path, tmp_path: Path) -> None:
    bare = tmp_path / "bare.toml"
    text = (PRESETS / "atlas-1.5m.toml").read_text()
    bare.write_text(text[: text.index("[[part]]")])
    order = PlantOrder(short, (f"platform.file={bare}",), "blend", ("none", None))
    ride = fly_on_plant(order)
    assert ride["result"] == "refused"
    assert table({order: ride}) == []


def test_the_tool_goes_on_where_it_was(short: Path, tmp_path: Path) -> None:
    """Rows are those of the command itself, and a second call flies only what is new."""
    words = ["--methods", "blend", "--jobs", "1", "--folder", tmp_path / "rides"]
    tool = [sys.executable, ROOT / "tools" / "plant_flights", short, *words]

    def called(*more: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run([*tool, *more], capture_output=True, text=True, check=True)

    first = called("--feedback", "none")
    assert "1 rides, 0 of them flown before" in first.stderr
    output = tmp_path / "rows.csv"
    second = called("--feedback", "none,fix", "--latency", "0.02", "-o", output)
    assert "2 rides, 1 of them flown before" in second.stderr
    assert first.stdout.splitlines()[:3] == second.stdout.splitlines()[:3]
    assert "| blend | fix, 20 ms | 1 |" in second.stdout
    with output.open() as file:
        heads, *rows = csv.reader(file)
    assert tuple(heads) == COLUMNS
    assert [line[:4] for line in rows] == [
        ["short", "blend", "none", ""],
        ["short", "blend", "fix", "0.02"],
    ]
    found = dict(zip(heads, rows[1], strict=True))
    command = [sys.executable, "-m", "atlas_cueing"]
    log, late = tmp_path / "ride.mcap", "platform.plant.fix_latency_s=0.02"
    settings = ["--set", PRESET, "--set", "cueing.method=blend"]
    subprocess.run([*command, "run", short, *settings, "-o", log], check=True, capture_output=True)
    flown = [*command, "plant", log, "--feedback", "fix", "--set", late, "--json"]
    told = json.loads(subprocess.run(flown, check=True, capture_output=True, text=True).stdout)
    for name in COLUMNS[4:]:
        assert float(found[name]) == told[name]
    assert degrees(told["orientation_error_max_rad"]) < 0.2


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--methods", "blend,nonsense"], "nonsense"),
        (["--feedback", "optic"], "none, odometry, gyro, fix"),
        (["--feedback", ","], "no such feedback"),
        (["--latency", "0,nan"], "numbers from 0 to 2"),
        (["--latency", "x"], "numbers from 0 to 2"),
        (["--platform", "nowhere"], "nowhere"),
    ],
)
def test_bad_usage_is_told_in_a_line(short: Path, words: list[str], told: str) -> None:
    tool = [sys.executable, ROOT / "tools" / "plant_flights", short, *words]
    done = subprocess.run(tool, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert told in done.stderr
    assert done.stderr.count("\n") == 1
