"""`--figure` of review and compare: what a figure for a paper holds, and where it is written."""

import re
import shutil
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import load_scenario

from .conftest import SCRIPT, Command

SVG = "{http://www.w3.org/2000/svg}"


METHODS = ("hedge", "still", "attitude")


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the same flight by three methods."""
    folder = tmp_path_factory.mktemp("flown")
    (folder / "s.toml").write_text(SCRIPT)
    for method in METHODS:
        scenario = load_scenario(folder / "s.toml", [f"cueing.method={method}"])
        run_scenario(scenario, folder / f"{method}.mcap")
    return folder


@pytest.fixture
def logs(command: Command, flown: Path, tmp_path: Path) -> tuple[str, ...]:
    """The logs, in the folder of the command."""
    assert command
    for method in METHODS:
        shutil.copy(flown / f"{method}.mcap", tmp_path)
    return tuple(f"{method}.mcap" for method in METHODS)


def texts(file: str) -> set[str]:
    """Texts of an SVG file: words, not outlines of letters."""
    root = ET.fromstring(Path(file).read_text("utf-8"))  # noqa: S314 - we have just written it
    return {"".join(each.itertext()).strip() for each in root.iter(f"{SVG}text")}


def lines(file: str) -> int:
    """How many lines of data: long paths that are not filled."""
    root = ET.fromstring(Path(file).read_text("utf-8"))  # noqa: S314
    paths = [path.get("d", "") for path in root.iter(f"{SVG}path")]
    return sum(path.count("L") > 8 for path in paths)


def test_a_ride_as_svg_and_pdf(command: Command, logs: tuple[str, ...]) -> None:
    ended = command("review", logs[0], "--figure", "ride.svg")
    assert (ended.status, ended.err) == (0, "")
    found = texts("ride.svg")
    assert {"vehicle", "rider", "wheel 1", "wheel 2", "wheel 3"} <= found
    assert {"time, s", "wheel speed, rad/s", "wheel acc., rad/s²"} <= found
    assert {"Specific force at the head", "z down, m/s²", "Angular rate", "z yaw, °/s"} <= found
    assert lines("ride.svg") == 6 * 2 + 2 * 3, "vehicle and rider in six axes, three wheels in two"
    assert command("review", "hedge.mcap", "--figure", "ride.pdf").status == 0
    pdf = Path("ride.pdf").read_bytes()
    assert pdf.startswith(b"%PDF-1.4\n%")
    assert b"/Type0" in pdf, "fonts as TrueType, their text can be searched"
    place = int(re.findall(rb"startxref\s+(\d+)", pdf)[-1])
    assert pdf[place:].startswith(b"xref"), "its parts are where it says"


def test_every_ride_beside_the_vehicle(command: Command, logs: tuple[str, ...]) -> None:
    assert command("compare", *logs, "--figure", "all.svg").status == 0
    assert {"vehicle", "hedge", "still", "attitude"} <= texts("all.svg")
    assert lines("all.svg") == 6 * (1 + 3)
    first = Path("all.svg").read_bytes()
    assert command("compare", *logs, "--figure", "all.svg", "--force").status == 0
    assert Path("all.svg").read_bytes() == first, "the same logs, the same bytes"


def test_other_flights_have_a_vehicle_each(command: Command, logs: tuple[str, ...]) -> None:
    command("run", "s.toml", "-o", "other.mcap", "--set", "vehicle.script=c1723")
    words = ("compare", logs[0], "other.mcap", "--different-flights", "--figure", "two.svg")
    assert command(*words).status == 0
    assert {"vehicle of hedge", "vehicle of other"} <= texts("two.svg")
    assert lines("two.svg") == 6 * (2 + 2)


@pytest.mark.parametrize("ending", ["svg", "pdf"])
def test_force_replaces_only_a_figure(command: Command, logs: tuple[str, ...], ending: str) -> None:
    words = ("review", logs[0], "--figure", f"x.{ending}")
    for foreign in (b"%PDF-1.4\n%\xac\xdc \xab\xba\nof another", b"<?xml version='1.0'?><svg/>"):
        Path(f"x.{ending}").write_bytes(foreign)
        refused = command(*words, "--force")
        assert (refused.status, refused.out) == (2, "")
        assert Path(f"x.{ending}").read_bytes() == foreign
    Path(f"x.{ending}").write_bytes(b"")
    assert command(*words, "--force").status == 0
    assert command(*words, "--force").status == 0


def test_bad_usage(command: Command, logs: tuple[str, ...]) -> None:
    before = Path(logs[0]).read_bytes()
    for words, told in (
        ((logs[0], "--figure", "x.png"), "--figure x.png: allowed: a name that ends in .svg, .pdf"),
        (("none.mcap", "--figure", "x.svg"), "no such file"),
    ):
        ended = command("review", *words)
        assert (ended.status, ended.out) == (2, "")
        assert told in ended.err
    Path("x.svg").hardlink_to(logs[0])
    assert "is a file that is read" in command("review", logs[0], "--figure", "x.svg").err
    assert Path(logs[0]).read_bytes() == before


def test_a_missing_matplotlib_names_the_extra(
    command: Command, logs: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in [m for m in sys.modules if m.split(".")[0] == "matplotlib"]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    ended = command("review", logs[0], "--figure", "x.svg", "--html", "x.html")
    assert (ended.status, ended.out) == (2, "")
    assert not Path("x.html").exists(), "nothing is written before all can be"
    assert "pip install 'atlas_cueing[plot]'" in ended.err
    assert not Path("x.svg").exists()


@pytest.mark.parametrize("command_line", [["review", "hedge.mcap"], ["compare", "hedge.mcap"]])
def test_a_page_and_a_figure_of_one_name(
    command: Command, logs: tuple[str, ...], command_line: list[str]
) -> None:
    assert logs
    more = ["still.mcap"] if command_line[0] == "compare" else []
    ended = command(*command_line, *more, "--html", "same.svg", "--figure", "same.svg")
    assert (ended.status, ended.out) == (2, "")
    assert "same.svg: is written twice" in ended.err
    assert not Path("same.svg").exists()
