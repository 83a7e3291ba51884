"""A recorded flight cued again."""

from pathlib import Path

import numpy as np
import pytest
from live.logs import largest_file

from atlas_cueing.cueing import CAUSAL_METHODS
from atlas_cueing.errors import InputError, OutputError
from atlas_cueing.recording import read_log
from atlas_cueing.review import cue_again, review_log
from atlas_cueing.scenario.cueing_table import TABLES

from .conftest import SCENARIOS, fly
from .corrupting import corrupted


@pytest.mark.parametrize("scenario", ["", "c172_elevator_doublet"])
def test_without_a_change_it_repeats_the_log_to_the_last_bit(
    flight: Path, tmp_path: Path, scenario: str
) -> None:
    """Also where JSBSim's step is no round number and the attitude jumps."""
    old = (
        fly(tmp_path, "duration_s=2.0", text=(SCENARIOS / f"{scenario}.toml").read_text())
        if scenario
        else flight
    )
    cue_again(old, (), tmp_path / "new.mcap")
    one, other = read_log(old), read_log(tmp_path / "new.mcap")
    assert one.tables.keys() == other.tables.keys()
    for topic, table in one.tables.items():
        assert np.array_equal(table.values, other.tables[topic].values), topic
    assert one.statuses == other.statuses
    assert one.attachments == other.attachments
    assert other.metadata == {**one.metadata, "recued_from": old.name}
    assert review_log(tmp_path / "new.mcap").clean


def test_another_method_and_platform(flight: Path, tmp_path: Path) -> None:
    """What comes out is what a run with these settings gives.

    The vehicle does not know how it is cued.
    """
    settings = ("cueing.method=attitude", "platform.preset=atlas-1.5m", "recording.chunk_ticks=100")
    scenario = cue_again(flight, settings, tmp_path / "new.mcap")
    assert (scenario.file.cueing.method, scenario.platform.name) == ("attitude", "atlas-1.5m")
    flown = read_log(fly(tmp_path, *settings, "platform.rider.head_m=[0,0,0]", name="flown.mcap"))
    new = read_log(tmp_path / "new.mcap")
    for topic, table in flown.tables.items():
        assert np.array_equal(table.values, new.tables[topic].values), topic
    assert new.metadata["method"] == "attitude"
    assert not np.array_equal(new.tables["/cue"].values, read_log(flight).tables["/cue"].values)


@pytest.mark.parametrize("old", ["blend", "classical"])
@pytest.mark.parametrize("new", CAUSAL_METHODS)
def test_another_method_comes_with_its_own_defaults(tmp_path: Path, old: str, new: str) -> None:
    """A log names every value; the old method's must not pass for wishes.

    Its slow turn, its gains, its stage.
    """
    flown = fly(tmp_path, "duration_s=0.5", f"cueing.method={old}")
    cue_again(flown, [f"cueing.method={new}"], tmp_path / "new.mcap")
    run = read_log(fly(tmp_path, "duration_s=0.5", f"cueing.method={new}", name="run.mcap"))
    recued = read_log(tmp_path / "new.mcap")
    assert recued.attachments == run.attachments
    assert np.array_equal(recued.tables["/wheels"].values, run.tables["/wheels"].values)


def test_what_was_set_for_the_old_method_stays_for_the_new_one(tmp_path: Path) -> None:
    flown = fly(
        tmp_path, "duration_s=0.5", "cueing.align_rate_deg_s=2.0", "cueing.stage.bandwidth_hz=4.0"
    )
    cueing = cue_again(flown, ["cueing.method=force"], tmp_path / "new.mcap").file.cueing
    assert isinstance(cueing, TABLES["force"])
    assert (cueing.align_rate_deg_s, cueing.align_time_s, cueing.stage.bandwidth_hz) == (
        2.0,
        0.5,
        4.0,
    )


def test_a_platform_file_is_found_where_the_command_is_called(
    flight: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = read_log(flight).attachments["platform.toml"].decode()
    (tmp_path / "mine.toml").write_text(text.replace("atlas-2.9m", "mine"))
    assert (
        cue_again(flight, ["platform.file=mine.toml"], tmp_path / "new.mcap").platform.name
        == "mine"
    )


def test_how_the_flight_ended_is_kept(flight: Path, tmp_path: Path) -> None:
    failed = corrupted(
        flight, tmp_path / "failed.mcap", metadata={"result": "vehicle_failed", "reason": "at 6 s"}
    )
    cue_again(failed, (), tmp_path / "new.mcap")
    metadata = read_log(tmp_path / "new.mcap").metadata
    assert (metadata["result"], metadata["reason"]) == ("vehicle_failed", "at 6 s")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (["vehicle.rate_hz=50"], "the flight is the recorded one"),
        (["duration_s=1"], "the flight is the recorded one"),
        (["cueing.method=magic"], "method = 'magic'"),
        (["platform.wheel_limits.speed_rad_s=-1"], "speed_rad_s"),
        (["platform.file=missing.toml"], "cannot be read"),
        (["nonsense"], "KEY=VALUE"),
    ],
)
def test_settings_that_do_not_fit(
    flight: Path, tmp_path: Path, settings: list[str], message: str
) -> None:
    with pytest.raises(InputError, match=message) as caught:
        cue_again(flight, settings, tmp_path / "new.mcap")
    assert "/tmp" not in str(caught.value) or "missing.toml" in str(caught.value)  # noqa: S108
    assert list(tmp_path.iterdir()) == []


def test_a_log_that_cannot_be_cued(flight: Path, tmp_path: Path) -> None:
    one = corrupted(
        flight, tmp_path / "one.mcap", lambda c: c.update({n: v[:1] for n, v in c.items()})
    )
    with pytest.raises(InputError, match="at least two states"):
        cue_again(one, (), tmp_path / "new.mcap")
    without = corrupted(
        flight, tmp_path / "without.mcap", attachments={"scenario.toml": b"broken ="}
    )
    with pytest.raises(InputError, match=r"the log's scenario\.toml: TOML: not valid"):
        cue_again(without, (), tmp_path / "new.mcap")
    with pytest.raises(InputError):
        cue_again(
            tmp_path / "s.toml" if (tmp_path / "s.toml").exists() else _text(tmp_path),
            (),
            tmp_path / "new.mcap",
        )


def test_a_full_disk_leaves_nothing(flight: Path, tmp_path: Path) -> None:
    """Half of a log that can be made again is of no use; what was there stays."""
    (tmp_path / "old.mcap").write_bytes(b"old")
    for file in ("old.mcap", "new.mcap"):
        with largest_file(20_000), pytest.raises(OutputError, match="File too large"):
            cue_again(flight, (), tmp_path / file)
    assert [path.name for path in tmp_path.iterdir()] == ["old.mcap"]
    assert (tmp_path / "old.mcap").read_bytes() == b"old"


def _text(folder: Path) -> Path:
    (folder / "text.mcap").write_text("no log")
    return folder / "text.mcap"


def test_a_recorded_flight_is_known_beforehand(flight: Path, tmp_path: Path) -> None:
    cue_again(flight, ["cueing.method=preview"], tmp_path / "new.mcap")
    old, new = read_log(flight), read_log(tmp_path / "new.mcap")
    assert np.array_equal(old.tables["/vehicle"].values, new.tables["/vehicle"].values)
    assert new.metadata["method"] == "preview"
    assert review_log(tmp_path / "new.mcap").clean
