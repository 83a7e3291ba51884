"""One flight, many rides: the model flies once in a worker, and every log is as flown alone."""

import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from atlas_cueing.batch import on_cluster
from atlas_cueing.batch import pool as workers
from atlas_cueing.batch.job import Job
from atlas_cueing.batch.job_result import JobResult
from atlas_cueing.batch.pool import fly_here
from atlas_cueing.run import run_scenario

from .sweeping import job_of, planned

SWEEP = """
name = "rides"
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
[sweep]
duration_s = [0.2, 0.3]
cueing.method = ["blend", "still", "perceptual"]
platform.preset = ["atlas-2.9m", "atlas-1.5m"]
"""

# A worker that writes down each model that is opened, and does something in its first flight.
_TELLING = """
import os
from pathlib import Path
from atlas_cueing.batch import execute, worker_main
from atlas_cueing.errors import VehicleError
told, plain = Path({told!r}), execute.open_vehicle
class Harmed:
    def __init__(self, vehicle):
        self.vehicle, self.dt, self.ticks = vehicle, vehicle.dt, 0
    @property
    def state(self):
        return self.vehicle.state
    def advance(self):
        self.ticks += 1
        if self.ticks == 12:
            {deed}
        return self.vehicle.advance()
def opened(scenario):
    with told.open("a") as file:
        file.write(f"{{scenario.file.duration_s}} ")
    return Harmed(plain(scenario))
execute.open_vehicle = opened
worker_main.main()
"""


def flown(
    monkeypatch: pytest.MonkeyPatch, folder: Path, deed: str = "pass", count: int = 1
) -> tuple[list[JobResult], list[str]]:
    """What came of all runs, in their order, and the durations of the models that were opened."""
    told = folder / "told"
    code = _TELLING.format(told=str(told), deed=deed)
    monkeypatch.setattr(workers, "_COMMAND", (sys.executable, "-c", code))
    results = {result.id: result for result in fly_here(jobs(folder), count)}
    return [results[job.id] for job in jobs(folder)], told.read_text().split()


def jobs(folder: Path) -> list[Job]:
    """The runs of the sweep, into a folder of its own."""
    (folder / "out").mkdir(exist_ok=True)
    return [job_of(run, folder / "out") for run in planned(folder, text=SWEEP)]


def test_each_flight_is_flown_once_and_every_log_is_as_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    results, opened = flown(monkeypatch, tmp_path)
    assert Counter(opened) == {"0.2": 1, "0.3": 1}
    assert len(results) == 12
    for run, result in zip(planned(tmp_path, text=SWEEP), results, strict=True):
        apart = run_scenario(run.scenario, tmp_path / "apart.mcap")
        assert replace(result, wall=0.0, log=None, id="") == replace(
            JobResult(**{name: getattr(apart, name) for name in FIELDS}, id=""),
            wall=0.0,
            log=None,
        )
        assert (tmp_path / "out" / f"{run.id}.mcap").read_bytes() == apart.log.read_bytes()


FIELDS = ("result", "reason", "log", "ticks", "duration", "wall", "evaluation")


def test_no_more_flights_than_workers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    results, opened = flown(monkeypatch, tmp_path, count=3)
    assert [result.result for result in results] == ["ok"] * 12
    assert 2 <= len(opened) <= 2 * 3


def test_a_dask_worker_stays_with_its_flight(tmp_path: Path) -> None:
    from distributed import Client, LocalCluster

    told, code = tmp_path / "told", _TELLING.format(told=str(tmp_path / "told"), deed="pass")

    def tell() -> None:
        from atlas_cueing.batch import pool

        pool._COMMAND = (sys.executable, "-c", code)

    text = SWEEP.replace("[0.2, 0.3]", "[0.2, 0.3, 0.4]").replace(', "perceptual"', "")
    (tmp_path / "out").mkdir()
    todo = [job_of(run, tmp_path / "out") for run in planned(tmp_path, text=text)]
    mixed = [todo[4 * flight + ride] for ride in range(4) for flight in range(3)]
    assert len({job.flight for job in mixed[:3]}) == 3
    with (
        LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0"
        ) as local,
        Client(local) as client,
        on_cluster(local.scheduler_address, 2) as fly,
    ):
        client.run(tell)
        results = list(fly(mixed, lambda: False))
    assert [each.result for each in results] == ["ok"] * 12
    assert 3 <= len(told.read_text().split()) <= 4  # one more when the last one is shared


def test_a_vehicle_that_fails_fails_in_every_ride(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    results, opened = flown(monkeypatch, tmp_path, "raise VehicleError(0.125, 'came apart')")
    assert Counter(opened) == {"0.2": 1, "0.3": 1}
    ends = {(each.result, each.reason, each.ticks) for each in results}
    assert ends == {("vehicle_failed", "vehicle failed at 0.125 s: came apart", 12)}


@pytest.mark.parametrize(
    ("deed", "result"), [("os.abort()", "crashed"), ("raise KeyError('x')", "failed")]
)
def test_a_model_that_crashes_crashes_in_every_ride(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, deed: str, result: str
) -> None:
    """Nothing is kept of it, so each run is what it is apart."""
    results, opened = flown(monkeypatch, tmp_path, deed)
    assert Counter(opened) == {"0.2": 6, "0.3": 6}
    assert {each.result for each in results} == {result}


def test_what_a_ride_does_not_change_is_the_same_flight(tmp_path: Path) -> None:
    runs = planned(tmp_path, text=SWEEP)
    assert len({run.flight for run in runs if run.scenario.file.duration_s == 0.2}) == 1
    assert len({run.flight for run in runs}) == 2
    for change in ("vehicle.rate_hz=100", 'vehicle.script="c1723"', "duration_s=0.25"):
        (other,) = {run.flight for run in planned(tmp_path, change, text=ONE)}
        assert other not in {run.flight for run in runs}


ONE = SWEEP.split("[sweep]")[0] + "[sweep]\ncueing.method = ['blend']\n"
