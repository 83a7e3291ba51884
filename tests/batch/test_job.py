from pathlib import Path

import pytest
from short_scenario import Load

from atlas_cueing.batch import plan
from atlas_cueing.batch.execute import fly_alone
from atlas_cueing.batch.job import Job, RunLimits
from atlas_cueing.run import run_scenario

from .sweeping import job_of, planned


def test_an_order_survives_its_line(tmp_path: Path) -> None:
    sent = job_of(planned(tmp_path)[0], tmp_path, RunLimits(12.5, 3.0))
    line = sent.to_line()
    assert line.count(b"\n") == 1
    assert line.endswith(b"\n")
    assert Job.from_line(line) == sent


def test_bytes_of_any_kind_go_along(tmp_path: Path) -> None:
    sent = Job("r", str(tmp_path), {"x.xml": bytes(range(256)).decode("latin-1")}, RunLimits())
    assert Job.from_line(sent.to_line()).files["x.xml"].encode("latin-1") == bytes(range(256))


RECORDING = """
name = "again"
[vehicle]
source = "recording"
log = "flown.mcap"
[platform]
preset = "atlas-2.9m"
"""


def test_a_file_too_large_to_carry_is_read_where_it_lies(load: Load, tmp_path: Path) -> None:
    """A recording: the run's id is that of its content, wherever it lies."""
    run_scenario(load("duration_s=0.2"), tmp_path / "flown.mcap")
    (tmp_path / "again.toml").write_text(RECORDING)
    (run,) = plan([tmp_path / "again.toml"])
    assert run.duration == pytest.approx(0.2, abs=0.01)
    sent = Job.from_line(Job.of(run, str(tmp_path), RunLimits()).to_line())
    assert sent.large == {"flown.mcap": str(tmp_path / "flown.mcap")}
    assert (tmp_path / "flown.mcap").read_bytes() not in map(str.encode, sent.files.values())
    assert fly_alone(sent, tmp_path).result == "ok"
    run_scenario(load("duration_s=0.3"), tmp_path / "flown.mcap")
    assert fly_alone(sent, tmp_path).result == "worker_differs"
    (tmp_path / "flown.mcap").unlink()
    assert fly_alone(sent, tmp_path).result == "refused"


def test_a_sweep_over_a_recording_in_another_folder(load: Load, tmp_path: Path) -> None:
    (tmp_path / "logs").mkdir()
    run_scenario(load("duration_s=0.2"), tmp_path / "logs/flown.mcap")
    text = RECORDING.replace("flown.mcap", "logs/flown.mcap")
    (tmp_path / "again.toml").write_text(text + '[sweep]\ncueing.method = ["blend", "attitude"]\n')
    runs = plan([tmp_path / "again.toml"])
    assert [run.settings["cueing.method"] for run in runs] == ["blend", "attitude"]
    for run in runs:
        sent = Job.from_line(Job.of(run, str(tmp_path), RunLimits()).to_line())
        assert sent.large == {"flown.mcap": str(tmp_path / "logs/flown.mcap")}
        assert fly_alone(sent, tmp_path).result == "ok"
