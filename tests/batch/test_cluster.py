"""On a local cluster: the same bytes as without one, and a lost worker costs nothing but time."""

import os
import signal
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from time import sleep
from typing import Any

import psutil
import pytest

from atlas_cueing.batch import cluster as cluster_module
from atlas_cueing.batch import fly_batch, fly_here, on_cluster
from atlas_cueing.batch.cluster import LOCAL, fly_job
from atlas_cueing.batch.folder_store import FolderStore
from atlas_cueing.errors import InputError

from .sweeping import LIMITS, job_of, planned
from .test_fly_batch import hashes


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """A scheduler with two workers on the loopback, as the module's text says to start them."""
    import dask
    from distributed import LocalCluster

    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 1}),
        LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0"
        ) as local,
    ):
        yield local.scheduler_address


def test_the_same_bytes_as_without_a_cluster(tmp_path: Path, address: str) -> None:
    runs = planned(tmp_path)
    with on_cluster(address, 2) as fly:
        outcomes = fly_batch(runs, FolderStore(tmp_path / "cluster"), fly, LIMITS)
    assert all(outcome.result and outcome.result.clean for outcome in outcomes)
    fly_batch(
        runs, FolderStore(tmp_path / "here"), lambda orders, stop: fly_here(orders, 1, stop), LIMITS
    )
    assert hashes(tmp_path / "cluster") == hashes(tmp_path / "here")
    assert len(hashes(tmp_path / "here")) == 4


def test_more_runs_than_the_scheduler_is_told_of_at_a_time(
    tmp_path: Path, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cluster_module, "_AHEAD", 0)
    runs = planned(tmp_path)
    with on_cluster(address, 2) as fly:
        assert {
            result.id for result in fly((job_of(run, tmp_path) for run in runs), lambda: False)
        } == {run.id for run in runs}


def test_a_worker_that_joins_late_gets_its_share(tmp_path: Path) -> None:
    from distributed import LocalCluster

    runs = planned(tmp_path)
    with (
        LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address="127.0.0.1:0") as local,
        on_cluster(local.scheduler_address, 1) as fly,
    ):
        joining = threading.Timer(0.5, local.scale, (1,))
        joining.start()
        results = list(fly((job_of(run, tmp_path) for run in runs), lambda: False))
        joining.join()
    assert {result.id for result in results} == {run.id for run in runs}


def test_stopping_begins_nothing_more(tmp_path: Path, address: str) -> None:
    with on_cluster(address, 2) as fly:
        assert list(fly([job_of(run, tmp_path) for run in planned(tmp_path)], lambda: True)) == []


def test_a_killed_dask_worker_costs_its_run_a_second_try(tmp_path: Path, address: str) -> None:
    from distributed import Client

    runs = planned(
        tmp_path, "vehicle.script=c1722", "duration_s=30", 'sweep.cueing.method=["blend","force"]'
    )

    def kill() -> None:
        while not list(tmp_path.glob("*.part")):
            sleep(0.02)
        with Client(address) as client:
            os.kill(next(iter(client.run(os.getpid).values())), signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    with on_cluster(address, 2) as fly:
        results = list(fly([job_of(run, tmp_path) for run in runs], lambda: False))
    killer.join()
    assert [result.result for result in results] == ["ok", "ok"]


def test_a_cluster_of_ones_own_listens_on_the_loopback_only() -> None:
    """A scheduler or worker runs whatever program it is handed."""
    with on_cluster(LOCAL, 1):
        here = psutil.Process()
        sockets = [
            each
            for process in (here, *here.children(recursive=True))
            for each in process.net_connections("inet")
        ]
    listening = [each.laddr.ip for each in sockets if each.status == psutil.CONN_LISTEN]
    assert set(listening) == {"127.0.0.1"}
    assert len(listening) >= 2


def test_a_run_done_before_its_worker_was_lost_is_not_flown_again(
    tmp_path: Path, address: str
) -> None:
    """The scheduler recomputes results that only the lost worker had.

    The result that is there answers instead.
    """
    run = planned(tmp_path)[0]
    with on_cluster(address, 2) as fly:
        (first,) = fly([job_of(run, tmp_path)], lambda: False)
    log = tmp_path / first.log
    before = (log.stat().st_ino, log.stat().st_mtime_ns)
    with on_cluster(address, 2) as fly:
        assert list(fly([job_of(run, tmp_path)], lambda: False)) == [first]
    assert (log.stat().st_ino, log.stat().st_mtime_ns) == before


class Future:
    """What the scheduler says of a task."""

    def __init__(self, status: str, error: Exception | None = None) -> None:
        self.status, self.error = status, error

    def exception(self) -> Exception | None:
        return self.error


class KilledWorker(Exception):  # noqa: N818 - distributed's name
    pass


@pytest.mark.parametrize(
    ("future", "cause", "reason"),
    [
        (
            Future("error", KilledWorker("4 times")),
            "worker_lost",
            "its worker process died 2 times",
        ),
        (
            Future("error", ModuleNotFoundError("atlas_cueing")),
            "worker_differs",
            "ModuleNotFoundError: atlas_cueing",
        ),
        (Future("cancelled"), "worker_lost", "the cluster cancelled it"),
    ],
)
def test_what_a_cluster_may_say_instead(
    tmp_path: Path, future: Any, cause: str, reason: str
) -> None:
    result = cluster_module._result(future, job_of(planned(tmp_path)[0], tmp_path))
    assert (result.result, result.final) == (cause, False)
    assert reason in result.reason


def test_a_task_survives_the_loss_of_its_process(tmp_path: Path) -> None:
    first, second, *_ = planned(tmp_path)
    assert fly_job(job_of(first, tmp_path)).result == "ok"
    os.kill(cluster_module._own.worker.pid, signal.SIGKILL)
    assert fly_job(job_of(second, tmp_path)).result == "ok"
    cluster_module._own.worker.close()
    del cluster_module._own.worker


def test_no_scheduler_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster_module, "_TIMEOUT", 0.3)
    with (
        pytest.raises(InputError, match=r"--cluster tcp://127\.0\.0\.1:1: no scheduler reached"),
        on_cluster("tcp://127.0.0.1:1", 1),
    ):
        pytest.fail("there is one")
    with (
        pytest.raises(InputError, match="--cluster nonsense: no scheduler reached"),
        on_cluster("nonsense", 1),
    ):
        pytest.fail("there is one")


@pytest.mark.parametrize("address", [LOCAL, "tcp://127.0.0.1:1"])
def test_without_dask(monkeypatch: pytest.MonkeyPatch, address: str) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(InputError, match=r"pip install 'atlas_cueing\[cluster\]'"),
        on_cluster(address, 1),
    ):
        pytest.fail("there is none")
