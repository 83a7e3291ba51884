import json
from math import inf, isnan
from pathlib import Path

import pytest

from atlas_cueing.batch.folder_store import FolderStore
from atlas_cueing.batch.job_result import FINAL, JobResult, keep, kept
from atlas_cueing.run import Evaluation

from .sweeping import kept_in

RECORD = JobResult(
    "ok",
    log=Path("r.mcap"),
    ticks=12,
    duration=0.1,
    wall=0.5,
    evaluation=Evaluation(
        metrics={"force_rms_m_s2": 1 / 3},
        limit_use={"wheel_speed": 2.0},
        violations=("wheel_speed = 2",),
    ),
    id="r",
)


def test_what_is_kept_comes_back(tmp_path: Path) -> None:
    (tmp_path / "r.mcap").touch()
    keep(RECORD, tmp_path)
    assert kept_in(tmp_path, "r") == RECORD
    assert {path.name for path in tmp_path.iterdir()} == {"r.json", "r.mcap"}
    table = json.loads((tmp_path / "r.json").read_text())
    assert (table["duration_s"], table["wall_s"], table["metrics"]) == (
        0.1,
        0.5,
        {"force_rms_m_s2": 1 / 3},
    )


def test_figures_that_are_no_numbers_are_null(tmp_path: Path) -> None:
    keep(
        JobResult("ok", evaluation=Evaluation(metrics={"a": inf, "b": float("nan")}), id="r"),
        tmp_path,
    )
    assert json.loads((tmp_path / "r.json").read_text())["metrics"] == {"a": None, "b": None}
    back = kept_in(tmp_path, "r")
    assert back
    assert all(isnan(value) for value in back.evaluation.metrics.values())


@pytest.mark.parametrize(
    "content",
    [b"", b"{", b"[]", b"3", b'{"id": "r"}', b"\xff", b"null", b"[" * 200_000],
    ids=range(8),
)
def test_a_damaged_record_is_none(tmp_path: Path, content: bytes) -> None:
    """A power cut may leave an empty file: that run is flown again."""
    (tmp_path / "r.json").write_bytes(content)
    assert kept_in(tmp_path, "r") is None


def test_a_record_without_its_log_or_of_another_run_is_none(tmp_path: Path) -> None:
    keep(RECORD, tmp_path)
    assert kept_in(tmp_path, "r") is None
    (tmp_path / "r.mcap").touch()
    assert kept_in(tmp_path, "r")
    (tmp_path / "r.json").rename(tmp_path / "s.json")
    assert kept_in(tmp_path, "s") is None
    assert kept_in(tmp_path, "r") is None


def test_only_what_would_end_the_same_is_final(tmp_path: Path) -> None:
    for result in (*FINAL, "recording_failed", "worker_lost", "worker_differs", "interrupted"):
        keep(JobResult(result, id="r"), tmp_path)
        assert (kept_in(tmp_path, "r") is not None) == (result in FINAL)


def test_clean_is_ok_within_all_limits() -> None:
    assert not RECORD.clean
    assert JobResult("ok", id="r").clean
    assert not JobResult("vehicle_failed", id="r").clean


def test_only_runs_that_are_asked_for_are_read(tmp_path: Path) -> None:
    keep(JobResult("ok", id="r"), tmp_path)
    (tmp_path / "summary.json").write_text("mine")
    assert kept(["r", "s"], FolderStore(tmp_path)) == {"r": JobResult("ok", id="r")}
    assert kept([], FolderStore(tmp_path)) == {}
    assert kept(["r"], FolderStore(tmp_path / "not_made_yet")) == {}


def test_a_log_elsewhere_is_no_log_of_this_batch(tmp_path: Path) -> None:
    (tmp_path / "elsewhere.mcap").touch()
    (tmp_path / "here").mkdir()
    keep(JobResult("ok", log=Path("../elsewhere.mcap"), id="r"), tmp_path / "here")
    assert kept_in(tmp_path / "here", "r") is None
