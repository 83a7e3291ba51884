"""`atlas-cueing design` by the command itself."""

import json
from pathlib import Path

import pytest

from atlas_cueing.scenario import load_platform

from .conftest import Command

QUICK = ("--searches", "2", "--jobs", "1")


@pytest.fixture
def ridden(command: Command, tmp_path: Path) -> Path:
    """A folder with two rides."""
    (tmp_path / "rides").mkdir()
    for method in ("force", "blend"):
        settings = ["--set", f"cueing.method={method}", "-o", f"rides/{method}.mcap"]
        assert command("run", "s.toml", *settings).status == 0
    return tmp_path


def test_a_design(command: Command, ridden: Path) -> None:
    words = ("design", "atlas-2.9m", "--flights", "rides", "-o", "out", "--also", "30/48.2")
    ended = command(*words, "--vary", "elevation,skew,preload", *QUICK, "--json")
    assert ended.status == 0, ended.err
    table = json.loads(ended.out)
    assert [each["method"] for each in table["flights"]] == ["blend", "force"]
    own, asked = table["layouts"][:2]
    assert (own["source"], own["elevation_deg"]) == ("platform", pytest.approx(40.0))
    assert own["condition_number"] == pytest.approx(1.6854, abs=1e-4)
    assert asked["condition_number"] == pytest.approx(1.0, abs=1e-3)
    for name in ("preload_needed_n", "torque_max_n_m", "wheel_load_max_n", "azimuth_deg"):
        assert isinstance(asked[name], float)
    chosen = table["layouts"][table["chosen"]]
    designed = load_platform(str(ridden / "out" / "platform.toml"))
    assert designed.name == "atlas-2.9m-designed"
    assert designed.geometry().condition_number == pytest.approx(chosen["condition_number"])
    page = (ridden / "out" / "index.html").read_text()
    assert page.startswith("<!doctype html>")
    assert page.count("<svg") == 3

    text = command(*words, "--vary", "elevation,skew,preload", *QUICK, "--choose", "1").out
    assert "1 asked chosen" in text
    ended = command(*words, "--vary", "elevation,skew,preload", *QUICK, "--choose", "4")
    assert ended.status == 2
    assert "at most 4 rows" in ended.err
    assert "searching" not in ended.err
    picked = load_platform(str(ridden / "out" / "platform.toml"))
    assert picked.geometry().condition_number == pytest.approx(1.0, abs=1e-3)


def test_logs_may_follow_one_another(command: Command, ridden: Path) -> None:
    logs = ("rides/force.mcap", "rides/blend.mcap")
    ended = command(
        "design", "atlas-2.9m", "--flights", *logs, "-o", "o", "--vary", "skew", *QUICK, "--json"
    )
    assert ended.status == 0, ended.err
    assert len(json.loads(ended.out)["flights"]) == 2
    assert (ridden / "o" / "layouts.json").read_text() == ended.out.removesuffix("\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--vary", "colour"], "--vary colour: allowed: elevation, skew"),
        (["--vary", "preload"], "nothing to search"),
        (["--range", "elevation=50:20"], "--range elevation=50:20: allowed: elevation=LOW:HIGH"),
        (["--range", "gear=1:2"], "KEY one of --vary: elevation, skew, azimuth"),
        (["--also", "30"], "--also 30: allowed: ELEVATION/SKEW"),
        (["--also", "30/nan"], "--also 30/nan: allowed"),
        (["--objective", "beauty"], "--objective beauty: allowed: preload_needed_n"),
        (["--flights", "nowhere"], "--flights nowhere: no such file or folder"),
        (["--flights", "empty"], "is a folder without logs"),
    ],
)
def test_mistakes(command: Command, ridden: Path, words: list[str], said: str) -> None:
    (ridden / "empty").mkdir()
    ended = command("design", "atlas-2.9m", "--flights", "rides", "-o", "out", *words, *QUICK)
    assert ended.status == 2
    assert said in ended.err
    assert not (ridden / "out").exists()


def test_platforms_that_cannot_be_designed(command: Command, ridden: Path) -> None:
    flights = ("--flights", "rides", "-o", "out")
    assert "not alike and evenly" in command("design", "atlas-orthogonal", *flights, *QUICK).err
    plain = ridden / "plain.toml"
    from atlas_cueing.scenario import presets

    text = presets()["atlas-2.9m"].read_text()
    plain.write_text(text[: text.index("# Assumed in all: nobody")])
    ended = command("design", "plain.toml", *flights, *QUICK)
    assert ended.status == 2
    assert "has no masses" in ended.err
    assert not (ridden / "out").exists()


def test_files_of_others_are_not_replaced(command: Command, ridden: Path) -> None:
    (ridden / "out").mkdir()
    mine = ridden / "out" / "platform.toml"
    from atlas_cueing.scenario import presets

    mine.write_bytes(presets()["atlas-2.9m"].read_bytes())
    for begun in ("atlas-2.9m", "out/platform.toml"):
        ended = command("design", begun, "--flights", "rides", "-o", "out", *QUICK)
        assert ended.status == 2
    assert "is the platform that is read" in ended.err
    assert mine.read_bytes() == presets()["atlas-2.9m"].read_bytes()
    assert {path.name for path in (ridden / "out").iterdir()} == {"platform.toml"}


def test_an_earlier_design_of_other_options_is_not_replaced(command: Command, ridden: Path) -> None:
    words = ("design", "atlas-2.9m", "--flights", "rides", "-o", "out", "--vary", "skew", *QUICK)
    assert command(*words).status == 0
    before = {path.name: path.read_bytes() for path in (ridden / "out").iterdir()}
    for other in (["--seed", "1"], ["--also", "30/48"], ["--objective", "condition_number"]):
        ended = command(*words, *other)
        assert ended.status == 2
        assert "is of an earlier design of other logs or options" in ended.err
    (ridden / "rides" / "blend.mcap").unlink()
    assert command(*words).status == 2
    assert {path.name: path.read_bytes() for path in (ridden / "out").iterdir()} == before
    (ridden / "out" / "layouts.json").unlink()
    assert command(*words).status == 2  # nothing tells that platform.toml is the same


def test_a_row_that_the_table_does_not_have(command: Command, ridden: Path) -> None:
    words = ("design", "atlas-2.9m", "--flights", "rides", "-o", "out", "--vary", "skew", *QUICK)
    ended = command(*words, "--objective", "condition_number", "--choose", "2")
    assert ended.status == 2
    assert "the table has 2 rows, allowed: 0 to 1" in ended.err
    assert not (ridden / "out" / "platform.toml").exists()


def test_gear_and_radius(command: Command, ridden: Path) -> None:
    words = ("design", "atlas-2.9m-halo", "--flights", "rides", "-o", "out", *QUICK)
    ended = command(*words, "--vary", "gear,radius", "--choose", "1")
    assert ended.status == 0, ended.err
    assert "motor" in ended.out
    designed = load_platform(str(ridden / "out" / "platform.toml"))
    assert designed.drive
    assert designed.drive.gear != 10.0
    assert designed.drive.torque_n_m == pytest.approx(60.0 * (designed.drive.gear or 0.0))
    assert designed.wheel[0].radius_m != 0.15
    flown = ("--set", "platform.file=out/platform.toml", "-o", "on_it.mcap", "--json")
    ended = command("recue", "rides/force.mcap", *flown)
    assert json.loads(ended.out)["result"] == "ok"


def test_a_gear_needs_a_motor(command: Command, ridden: Path) -> None:
    from atlas_cueing.scenario import presets

    text = presets()["atlas-2.9m"].read_text()
    (ridden / "bare.toml").write_text(text.replace("\ngear =", "\n# gear ="))
    ended = command("design", "bare.toml", "--flights", "rides", "-o", "o", "--vary", "gear")
    assert ended.status == 2
    assert "has no drive.gear" in ended.err


def test_on_a_cluster(command: Command, ridden: Path) -> None:
    pytest.importorskip("distributed")
    words = ("design", "atlas-2.9m", "--flights", "rides", "--vary", "skew", *QUICK, "--json")
    alone = json.loads(command(*words, "-o", "one").out)
    ended = command(*words, "-o", "two", "--cluster", "local")
    assert ended.status == 0, ended.err
    assert json.loads(ended.out)["layouts"] == alone["layouts"]
    assert ridden.exists()
