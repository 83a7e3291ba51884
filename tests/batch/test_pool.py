from pathlib import Path

import pytest

from atlas_cueing.batch import pool as workers
from atlas_cueing.batch.job_result import JobResult, keep
from atlas_cueing.batch.pool import Worker, fly_here

from .sweeping import job_of, planned, sabotage


def test_all_orders_are_flown_by_as_many_workers_as_asked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started = []

    class Counted(Worker):
        def __init__(self) -> None:
            super().__init__()
            started.append(self.pid)

    monkeypatch.setattr(workers, "Worker", Counted)
    runs = planned(tmp_path)
    results = list(fly_here([job_of(run, tmp_path) for run in runs], 2))
    assert {result.id for result in results} == {run.id for run in runs}
    assert {result.result for result in results} == {"ok"}
    assert len(started) == 2
    assert list(fly_here([], 2)) == []
    assert len(started) == 2


def test_a_run_that_loses_its_worker_is_begun_again_and_then_given_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sabotage(
        monkeypatch,
        "Path(job.place, 'tries').open('a').write('x'); os.kill(os.getppid(), signal.SIGKILL)",
    )
    results = list(fly_here([job_of(run, tmp_path) for run in planned(tmp_path)], 2))
    by_method = {result.id.split("-")[2]: result.result for result in results}
    assert by_method == {"blend": "ok", "attitude": "worker_lost", "force": "ok", "classical": "ok"}
    assert (tmp_path / "tries").read_text() == "xx"
    assert not next(result for result in results if result.result == "worker_lost").final


def test_a_worker_lost_by_accident_costs_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    once = (
        "Path(job.place, 'once').exists() or (Path(job.place, 'once').touch(),"
        " os.kill(os.getppid(), signal.SIGKILL))"
    )
    sabotage(monkeypatch, once)
    results = list(fly_here([job_of(run, tmp_path) for run in planned(tmp_path)], 1))
    assert [result.result for result in results] == ["ok"] * 4
    assert (tmp_path / "once").exists()


def test_stopping_kills_the_run_under_way(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sabotage(monkeypatch, "Path(job.place, 'begun').touch(); time.sleep(600)")
    runs = planned(tmp_path, 'sweep.cueing.method=["attitude"]')
    assert (
        list(fly_here([job_of(run, tmp_path) for run in runs], 1, (tmp_path / "begun").exists))
        == []
    )
    assert (tmp_path / "begun").exists()


def test_leaving_early_leaves_no_workers(tmp_path: Path) -> None:
    flying = fly_here([job_of(run, tmp_path) for run in planned(tmp_path)], 1)
    next(flying)
    flying.close()
    assert len(list(tmp_path.glob("*.json"))) < 4


COUNT = "open('{}', 'a').write('x'); time.sleep(0.5)"


@pytest.mark.parametrize("kind", ["", "file://"])
def test_a_run_that_is_ordered_twice_is_flown_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    """As a cluster does that lost the word of it."""
    sabotage(monkeypatch, COUNT.format(tmp_path / "flights"))
    (run,) = planned(tmp_path, 'sweep.cueing.method=["attitude"]')
    (tmp_path / "out").mkdir()
    place = f"{kind}{tmp_path / 'out'}"
    first, again = fly_here([job_of(run, place)] * 2, 1)
    assert first == again
    assert first.result == "ok"
    assert (tmp_path / "flights").read_text() == "x"
    (tmp_path / "out" / first.log).unlink()
    list(fly_here([job_of(run, place)], 1))
    assert (tmp_path / "flights").read_text() == "xx"


def test_two_workers_at_the_same_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As when a driver is gone and the next one finds its runs still under way.

    The second waits, and has no need to fly.
    """
    sabotage(monkeypatch, COUNT.format(tmp_path / "flights"))
    (run,) = planned(tmp_path, 'sweep.cueing.method=["attitude"]')
    (tmp_path / "out").mkdir()
    first, second = fly_here([job_of(run, tmp_path / "out")] * 2, 2)
    assert first == second
    assert first.clean
    assert (tmp_path / "flights").read_text() == "x"


def test_what_had_to_be_killed_is_flown_when_it_is_ordered(tmp_path: Path) -> None:
    run = planned(tmp_path)[0]
    keep(JobResult("timed_out", id=run.id), tmp_path)
    (result,) = fly_here([job_of(run, tmp_path)], 1)
    assert result.result == "ok"
