"""Runs into a folder, again and again."""

from collections.abc import Callable, Iterable, Iterator
from hashlib import sha256
from pathlib import Path

import pytest

from atlas_cueing.batch import fly_batch, missing
from atlas_cueing.batch.folder_store import FolderStore
from atlas_cueing.batch.job import Job
from atlas_cueing.batch.job_result import JobResult, keep
from atlas_cueing.batch.pool import fly_here
from atlas_cueing.errors import OutputError

from .sweeping import LIMITS, fly_in_line, planned


def hashes(folder: Path) -> dict[str, str]:
    return {
        path.name: sha256(path.read_bytes()).hexdigest() for path in sorted(folder.glob("*.mcap"))
    }


def test_one_worker_or_two_give_the_same_bytes(tmp_path: Path) -> None:
    runs = planned(tmp_path)
    for jobs in (1, 2):
        outcomes = fly_batch(
            runs,
            FolderStore(tmp_path / str(jobs)),
            lambda orders, stop, n=jobs: fly_here(orders, n, stop),
            LIMITS,
        )
        assert [outcome.run for outcome in outcomes] == runs
        assert all(outcome.result and outcome.result.clean for outcome in outcomes)
    assert hashes(tmp_path / "1") == hashes(tmp_path / "2")
    assert len(hashes(tmp_path / "1")) == 4


def test_a_second_time_flies_only_what_is_missing(tmp_path: Path) -> None:
    out = tmp_path / "out"
    results = FolderStore(out)
    flown: list[str] = []
    runs = planned(tmp_path)
    first = fly_batch(
        runs[:2], results, fly_in_line, LIMITS, tell=lambda result: flown.append(result.id)
    )
    again = fly_batch(
        runs, results, fly_in_line, LIMITS, tell=lambda result: flown.append(result.id)
    )
    assert sorted(flown) == sorted(run.id for run in runs)
    assert [outcome.result for outcome in again[:2]] == [outcome.result for outcome in first]
    (out / f"{runs[1].id}.mcap").unlink()
    (out / f"{runs[2].id}.json").write_bytes(b"")
    assert {run.id for run in missing(runs, results)} == {runs[1].id, runs[2].id}
    fly_batch(runs, results, fly_in_line, LIMITS, tell=lambda result: flown.append(result.id))
    assert sorted(flown[4:]) == sorted([runs[1].id, runs[2].id])
    assert missing(runs, results) == []


def test_the_longest_begins_first(tmp_path: Path) -> None:
    runs = planned(tmp_path, 'sweep.cueing.method=["blend"]', "sweep.duration_s=[0.2, 0.3, 0.1]")
    assert [run.duration for run in missing(runs, FolderStore(tmp_path))] == [0.3, 0.2, 0.1]


@pytest.mark.parametrize(
    ("result", "todo"),
    [("crashed", 1), ("timed_out", 1), ("out_of_memory", 1), ("vehicle_failed", 0)],
)
def test_retry_is_for_what_had_to_be_killed(tmp_path: Path, result: str, todo: int) -> None:
    run, *_ = planned(tmp_path)
    keep(JobResult(result, id=run.id), tmp_path)
    assert missing([run], FolderStore(tmp_path)) == []
    assert len(missing([run], FolderStore(tmp_path), retry=True)) == todo


def test_what_was_not_flown_is_none(tmp_path: Path) -> None:
    runs = planned(tmp_path)
    told: list[JobResult] = []
    outcomes = fly_batch(
        runs,
        FolderStore(tmp_path / "out"),
        fly_in_line,
        LIMITS,
        tell=told.append,
        stop=lambda: len(told) == 3,
    )
    assert [outcome.result is not None for outcome in outcomes] == [True, True, True, False]


def test_a_run_to_be_retried_and_not_flown_is_not_reported_as_it_was(tmp_path: Path) -> None:
    run, *_ = planned(tmp_path)
    keep(JobResult("crashed", id=run.id), tmp_path)
    (outcome,) = fly_batch(
        [run], FolderStore(tmp_path), fly_in_line, LIMITS, retry=True, stop=lambda: True
    )
    assert outcome.result is None


def test_a_folder_in_use(tmp_path: Path) -> None:
    runs = planned(tmp_path)

    def fly(_orders: Iterable[Job], _stop: Callable[[], bool]) -> Iterator[JobResult]:
        with pytest.raises(OutputError, match="another batch"):
            fly_batch(runs, FolderStore(tmp_path), fly_in_line, LIMITS)
        yield from ()

    fly_batch(runs, FolderStore(tmp_path), fly, LIMITS)
    assert not list(tmp_path.glob("*.mcap"))
