"""A log with a flight and nothing else: what review says of it, and how it is cued."""

import json
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.cli import main
from atlas_cueing.errors import InputError
from atlas_cueing.recording import Log, read_log, write_vehicle_log
from atlas_cueing.review import cue_again, is_flight_alone, open_run, review_flight, review_log

TOLD = {"origin": "drive.csv", "map": "csv", "attitude": "complementary filter of 10 s"}


def alone(folder: Path, flight: Path, *, name: str = "alone.mcap", **changes: float) -> Path:
    """The flight of a log in a log of its own; a field of its tick 100 may be changed."""
    table = read_log(flight).tables["/vehicle"]
    rows = table.values.copy()
    for field, value in changes.items():
        rows[100, table.fields.index(field)] = value
    (folder / name).write_bytes(write_vehicle_log(rows, TOLD, {"map.toml": b"x = 1\n"}))
    return folder / name


def test_review_says_what_it_is(
    flight: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = alone(tmp_path, flight)
    assert main(["review", str(log)]) == 0
    told = capsys.readouterr().out
    for line in ("verdict   clean", "a flight alone, not cued yet", "origin    drive.csv", "recue"):
        assert line in told
    assert main(["review", str(log), "--json"]) == 0
    table = json.loads(capsys.readouterr().out)
    assert (table["kind"], table["verdict"], table["metadata"]["map"]) == ("flight", "clean", "csv")


def test_its_figures_are_those_of_the_flight(flight: Path, tmp_path: Path) -> None:
    columns = read_log(flight)
    figures = review_flight(read_log(alone(tmp_path, flight))).metrics
    f = np.linalg.norm(columns.vector("/vehicle", "f"), axis=1)
    assert figures["force_rms_m_s2"] == pytest.approx(np.sqrt(np.mean(f**2)))
    assert figures["force_max_m_s2"] == f.max()
    assert figures["step_s"] == pytest.approx(1.0 / 120.0)
    assert figures["attitude_rate_rms_rad_s"] < 5e-3, "JSBSim's rates explain its attitude"


@pytest.mark.parametrize(
    ("changes", "finding"),
    [
        ({"fx_m_s2": 1e5}, "specific force"),
        ({"wx_rad_s": np.nan}, "body rate"),
        ({"q_nb_w": 0.0}, "attitude of norm"),
        ({"time_s": 0.8301}, "no equal steps|must go on"),
    ],
)
def test_what_cannot_be_flown_is_a_finding(
    flight: Path, tmp_path: Path, changes: dict[str, float], finding: str
) -> None:
    log = alone(tmp_path, flight, **changes)
    found = review_flight(read_log(log))
    assert not found.clean
    assert any(word in found.findings[0] for word in finding.split("|"))
    assert main(["review", str(log), "--json"]) == 1


@pytest.mark.parametrize("option", ["--html", "--replay"])
def test_it_has_no_page(
    flight: Path, tmp_path: Path, option: str, capsys: pytest.CaptureFixture[str]
) -> None:
    log = alone(tmp_path, flight)
    assert main(["review", str(log), option, str(tmp_path / "page.html")]) == 2
    assert "cue it first: atlas-cueing recue" in capsys.readouterr().err
    assert not (tmp_path / "page.html").exists()
    assert main(["compare", str(log), str(flight)]) == 2
    with pytest.raises(InputError, match="holds a flight alone"):
        open_run(log)
    assert not is_flight_alone(read_log(flight))


def test_it_is_cued_by_the_settings(flight: Path, tmp_path: Path) -> None:
    """The same vehicle on the same platform gives the same cue, motion and wheels."""
    log, new = alone(tmp_path, flight), tmp_path / "new.mcap"
    (tmp_path / "platform.toml").write_bytes(read_log(flight).attachments["platform.toml"])
    settings = ["cueing.method=blend", f"platform.file={tmp_path / 'platform.toml'}"]
    cue_again(log, settings, new)
    one, other = read_log(flight), read_log(new)
    for topic, table in one.tables.items():
        assert np.array_equal(table.values, other.tables[topic].values), topic
    assert review_log(new).clean
    assert other.metadata["attitude"] == TOLD["attitude"], "the mark goes along"
    again = tmp_path / "again.mcap"
    cue_again(new, [], again)
    assert np.array_equal(read_log(again).tables["/wheels"].values, other.tables["/wheels"].values)


def test_what_is_missing_is_named(flight: Path, tmp_path: Path) -> None:
    log = alone(tmp_path, flight)
    with pytest.raises(InputError, match=r"--set platform\.preset=NAME, allowed: atlas-1\.5m, "):
        cue_again(log, ["cueing.method=attitude"], tmp_path / "new.mcap")
    gap = alone(tmp_path, flight, name="gap.mcap", time_s=0.8301)
    with pytest.raises(InputError, match=r"no equal steps|must go on"):
        cue_again(gap, ["platform.preset=atlas-2.9m"], tmp_path / "new.mcap")
    assert not (tmp_path / "new.mcap").exists()


def test_a_log_without_a_flight_is_no_flight_alone(flight: Path) -> None:
    log = read_log(flight)
    rest = {topic: table for topic, table in log.tables.items() if topic != "/vehicle"}
    assert not is_flight_alone(Log(log.path, rest, {}, {}, ()))
