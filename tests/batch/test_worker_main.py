"""A worker as a process: what its runs do to it, and what it says of them."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from time import sleep

import pytest
from waiting import until

from atlas_cueing.batch import pool as workers
from atlas_cueing.batch.folder_store import FolderStore
from atlas_cueing.batch.job import Job, RunLimits
from atlas_cueing.batch.job_result import JobResult

from .sweeping import LIMITS, job_of, kept_in, planned, sabotage

METHODS = ("blend", "attitude")


def told(orders: list[Job]) -> list[JobResult]:
    """What a worker of the present command says to the orders."""
    process = subprocess.Popen(workers._COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdin
    assert process.stdout
    results = []
    for each in orders:
        process.stdin.write(each.to_line())
        process.stdin.flush()
        results.append(JobResult.from_json(json.loads(process.stdout.readline())))
    assert process.communicate(timeout=60) == (b"", None)
    assert process.returncode == 0
    return results


def jobs(folder: Path, limits: RunLimits) -> list[Job]:
    """A run that comes to harm under `sabotage`, and another after it in the same worker."""
    first, second, *_ = planned(folder)
    return [
        job_of(second, folder, limits),
        job_of(first, folder, replace(limits, time=LIMITS.time)),
    ]


@pytest.mark.parametrize(
    ("deed", "limits", "result", "reason"),
    [
        ("os.kill(os.getpid(), signal.SIGSEGV)", RunLimits(), "crashed", "ended by SIGSEGV"),
        (
            "os.write(2, b'free(): invalid pointer'); os.abort()",
            RunLimits(),
            "crashed",
            "ended by SIGABRT: free(): invalid pointer",
        ),
        ("os._exit(3)", RunLimits(), "crashed", "ended with exit status 3"),
        (
            "print('{}', flush=True); time.sleep(600)",
            RunLimits(time=1.0),
            "timed_out",
            "not over after 1 s",
        ),
        (
            "bytearray(2 * 10**9)",
            RunLimits(memory=1.0),
            "out_of_memory",
            "needs more than 1 GB: ended with exit status 1",
        ),
        (
            "alone.run_scenario = lambda *_, **__: bytearray(2 * 10**9)"
            "\n        return fly(job, workdir, flight)",
            RunLimits(memory=1.0),
            "out_of_memory",
            "needs more than 1 GB",
        ),
    ],
    ids=["signal", "abort", "exit", "hang", "memory", "memory-in-run"],
)
def test_one_runs_harm_is_no_others(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    deed: str,
    limits: RunLimits,
    result: str,
    reason: str,
) -> None:
    sabotage(monkeypatch, deed)
    harmed, sound = told(jobs(tmp_path, limits))
    assert (harmed.result, harmed.reason) == (result, reason)
    assert kept_in(tmp_path, harmed.id) == harmed
    assert sound.result == "ok"
    assert (tmp_path / f"{sound.id}.mcap").is_file()


def test_what_a_killed_run_recorded_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sabotage(monkeypatch, "(Path(job.place) / f'{job.id}.mcap.part').touch(); os.abort()")
    harmed, _ = told(jobs(tmp_path, RunLimits()))
    assert harmed.log == Path(f"{harmed.id}.mcap.part")


def test_the_real_command_from_a_folder_of_strange_modules(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing in the working directory is imported, nor gets printed text among the results."""
    (tmp_path / "json.py").write_text("raise SystemExit('the wrong json')")
    monkeypatch.chdir(tmp_path)
    assert [result.result for result in told(jobs(tmp_path, RunLimits()))] == ["ok", "ok"]


def test_what_a_library_prints_in_the_worker_is_no_record(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    noisy = "os.register_at_fork(before=lambda: os.write(1, b'noise'))"
    code = (
        f"import os; from atlas_cueing.batch import worker_main as worker; {noisy}; worker.main()"
    )
    monkeypatch.setattr(workers, "_COMMAND", (sys.executable, "-c", code))
    assert [result.result for result in told(jobs(tmp_path, RunLimits()))] == ["ok", "ok"]


def test_when_the_driver_goes_the_run_goes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sabotage(monkeypatch, "Path(job.place, 'pid').write_text(str(os.getpid())); time.sleep(600)")
    process = subprocess.Popen(workers._COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdin
    process.stdin.write(jobs(tmp_path, RunLimits())[0].to_line())
    process.stdin.flush()
    pid = tmp_path / "pid"
    while process.poll() is None and not (pid.exists() and pid.read_text()):
        sleep(0.02)
    assert process.communicate(timeout=60) == (b"", None)
    with pytest.raises(ProcessLookupError):
        os.kill(int(pid.read_text()), 0)
    assert not list(tmp_path.glob("*.json"))


def test_a_worker_that_waits_for_another_ends_with_its_driver(tmp_path: Path) -> None:
    mine = jobs(tmp_path, RunLimits())[0]
    process = subprocess.Popen(workers._COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    with FolderStore(tmp_path).claimed(mine.id):
        assert process.communicate(mine.to_line(), timeout=60) == (b"", None)
    assert process.returncode == 0
    assert not list(tmp_path.glob("*.mcap*"))


@pytest.mark.skipif(sys.platform != "linux", reason="death with the parent needs Linux's prctl")
def test_when_the_worker_is_killed_the_run_goes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    deed = (
        "alone.run_scenario = lambda *_, **__: (Path(job.place, 'pid')"
        ".write_text(str(os.getpid())), time.sleep(600))"
    )
    sabotage(monkeypatch, deed)
    process = subprocess.Popen(workers._COMMAND, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdin
    process.stdin.write(jobs(tmp_path, RunLimits())[0].to_line())
    process.stdin.flush()
    pid = tmp_path / "pid"
    while process.poll() is None and not (pid.exists() and pid.read_text()):
        sleep(0.02)
    process.kill()
    # stdout ends only when the run, which holds it too, has let go of it
    process.communicate(timeout=60)
    state = Path(f"/proc/{pid.read_text()}/stat")
    until(lambda: not state.exists() or state.read_text().split()[2] in "ZX", 60.0)
