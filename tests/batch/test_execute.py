"""A run in a process of its own; here that process is the test's, so nothing is confined."""

import subprocess
import sys
from pathlib import Path

import pytest

from atlas_cueing.batch import execute as alone
from atlas_cueing.batch.execute import fly_alone, left_by
from atlas_cueing.batch.job import Job, RunLimits
from atlas_cueing.batch.job_result import JobResult
from atlas_cueing.errors import InputError, OutputError
from atlas_cueing.run import run_scenario
from atlas_cueing.scenario import presets

from .sweeping import SWEEP, job_of, planned


def test_log_and_figures_are_those_of_a_plain_run(tmp_path: Path) -> None:
    run = planned(tmp_path)[0]
    out = tmp_path / "out"
    out.mkdir()
    result = fly_alone(job_of(run, out), out)
    plain = run_scenario(run.scenario, tmp_path / "plain.mcap")
    assert (result.result, result.log, result.ticks) == ("ok", Path(f"{run.id}.mcap"), plain.ticks)
    assert (result.evaluation.metrics, result.evaluation.limit_use) == (
        plain.evaluation.metrics,
        plain.evaluation.limit_use,
    )
    assert (out / result.log).read_bytes() == plain.log.read_bytes()
    assert [path.name for path in out.iterdir()] == [str(result.log)]


def test_a_model_that_does_not_load_is_a_failed_vehicle(tmp_path: Path) -> None:
    run = planned(tmp_path, "vehicle.script=unitconversions")[0]
    result = fly_alone(job_of(run, tmp_path), tmp_path)
    assert (result.result, result.log, result.ticks) == ("vehicle_failed", None, 0)
    assert "must be <runscript>" in result.reason


def test_a_model_that_goes_wild(tmp_path: Path) -> None:
    run = planned(tmp_path, "vehicle.script=cannonball", "duration_s=600")[0]
    result = fly_alone(job_of(run, tmp_path), tmp_path)
    assert (result.result, result.log) == ("vehicle_failed", Path(f"{run.id}.mcap"))
    assert result.ticks > 10


def broken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: Exception) -> JobResult:
    def fail(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(alone, "run_scenario", fail)
    return fly_alone(job_of(planned(tmp_path)[0], tmp_path, RunLimits(memory=3.0)), tmp_path)


@pytest.mark.parametrize(
    ("error", "cause", "reason"),
    [
        (MemoryError(), "out_of_memory", "needs more than 3 GB"),
        (OutputError("No space left"), "recording_failed", "No space left"),
        (OSError(28, "No space left"), "recording_failed", "OSError: [Errno 28] No space left"),
        (ZeroDivisionError("oops"), "failed", "ZeroDivisionError: oops"),
    ],
)
def test_what_else_may_happen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: Exception, cause: str, reason: str
) -> None:
    result = broken(tmp_path, monkeypatch, error)
    assert (result.result, result.reason) == (cause, reason)
    assert result.final == (cause in ("out_of_memory", "failed"))


def test_a_worker_of_other_versions_does_not_fly(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sent = job_of(planned(tmp_path)[0], tmp_path)
    monkeypatch.setattr("atlas_cueing.batch.run_id._version", lambda _: b"another")
    result = fly_alone(sent, tmp_path)
    assert result.result == "worker_differs"
    assert not list(tmp_path.glob("*.mcap*"))
    assert not result.final


def test_a_folder_that_is_gone(tmp_path: Path) -> None:
    gone = tmp_path / "gone"
    assert fly_alone(job_of(planned(tmp_path)[0], gone), gone).result == "recording_failed"


def test_a_scenario_that_the_worker_cannot_read_is_a_failure_of_that_run(tmp_path: Path) -> None:
    assert (
        fly_alone(Job("r", str(tmp_path), {"scenario.toml": "["}, RunLimits()), tmp_path).result
        == "refused"
    )


def test_a_first_pose_that_is_not_safe_at_rest_is_no_failed_vehicle(tmp_path: Path) -> None:
    """`run` refuses it with the same words. The cabin, of 220 kg, hangs 1.2 m off the centre."""
    (tmp_path / "p.toml").write_text(
        presets()["atlas-2.9m"]
        .read_text()
        .replace("[0.0, 0.0, -0.1]", "[1.2, 0.0, -0.1]")
        .replace("margin = 1.25", "keep = true\nmargin = 1.25")
    )
    own = SWEEP.replace('preset = "atlas-2.9m"', 'file = "p.toml"')
    run = planned(tmp_path, text=own)[0]
    with pytest.raises(InputError) as refused:
        run_scenario(run.scenario, tmp_path / "run.mcap")
    result = fly_alone(job_of(run, tmp_path), tmp_path)
    assert (result.result, result.log, result.ticks) == ("refused", None, 0)
    assert "at rest in the first pose" in result.reason
    assert result.reason == str(refused.value)
    assert result.final


def test_a_log_that_was_left_is_named(tmp_path: Path) -> None:
    sent = Job("r", str(tmp_path), {}, RunLimits())
    assert left_by(sent, tmp_path) is None
    (tmp_path / "r.mcap").touch()
    assert left_by(sent, tmp_path) == Path("r.mcap")
    (tmp_path / "r.mcap.part").touch()
    assert left_by(sent, tmp_path) == Path("r.mcap.part")


def test_a_confined_process_is_refused_memory() -> None:
    code = (
        "from atlas_cueing.batch.execute import confine; confine(1.0)\n"
        "try: bytearray(2 * 10**9)\n"
        "except MemoryError: print('refused')\n"
    )
    told = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True
    ).stdout
    assert told == "refused\n"
