"""Runs on many machines, by dask.distributed (extra `cluster`).

On machines that trust each other and reach the same folder or URL, each with the same versions
installed:

    export DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES=1
    dask scheduler --host HOST --port 8786 --dashboard-address HOST:8787
    # on every machine
    dask worker tcp://HOST:8786 --host HERE --dashboard-address HERE:0 --nworkers 8 --nthreads 1
    # or with -o s3://bucket/results
    atlas-cueing batch scenarios -o /shared/results --cluster tcp://HOST:8786

Whoever reaches the scheduler or a worker can run any program there: HOST and HERE are 127.0.0.1 or
of a private network. Without --dashboard-address both answer on all interfaces, also with
--no-dashboard.
"""

import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from itertools import islice
from time import sleep
from typing import Any

from ..errors import InputError, MissingExtraError
from .job import Job
from .job_result import JobResult
from .pool import ATTEMPTS, Stop, Worker, lost

LOCAL = "local"  # in place of an address: a scheduler and workers on 127.0.0.1, for this batch only
_UNDER_WAY = 2000  # runs that the scheduler knows at a time; it needs some 10 kB for each
_PATIENCE = 0.1  # s from one look at the scheduler to the next
_TIMEOUT = 10.0  # s to reach the scheduler
_own = threading.local()  # a worker process for each thread of a dask worker


@contextmanager
def on_cluster(
    address: str, jobs: int
) -> Iterator[Callable[[Iterable[Job], Stop], Iterator[JobResult]]]:
    """Fly jobs on a dask cluster and yield their results as they come.

    address: of a scheduler (`tcp://HOST:PORT`), or LOCAL for `jobs` workers on this machine.

    The runs of a lost worker are begun again elsewhere; one that loses ATTEMPTS workers is given up
    as `worker_lost`. Once `stop` is true nothing more is begun. Raises InputError when dask is not
    installed or the scheduler cannot be reached.
    """
    with dask_client(address, jobs) as client:
        yield partial(_fly, client)


def _fly(client: Any, todo: Iterable[Job], stop: Stop) -> Iterator[JobResult]:
    from distributed import as_completed

    jobs = iter(todo)
    known: dict[str, Job] = {}

    def submit(count: int) -> list[Any]:
        """Submit the next jobs, `count` at most, and return their futures."""
        batch = list(islice(jobs, count))
        known.update({job.id: job for job in batch})
        # The key makes a run that is under way for a driver that was killed be waited for instead
        # of flown twice.
        return [client.submit(fly_job, job, key=job.id, retries=0) for job in batch]

    waiting = as_completed(submit(_UNDER_WAY))
    while waiting.count() and not stop():
        if not waiting.has_ready():
            sleep(_PATIENCE)
            continue
        for future in waiting.next_batch(block=True):
            result = _result(future, known.pop(future.key))
            waiting.update(submit(1))
            yield result


def _result(future: Any, job: Job) -> JobResult:
    if future.status == "finished":
        result: JobResult = future.result()
        return result
    if future.status == "cancelled":
        return JobResult("worker_lost", "the cluster cancelled it", id=job.id)
    error = future.exception()
    if type(error).__name__ == "KilledWorker":
        return lost(job)
    reason = f"the cluster's worker cannot fly it: {type(error).__name__}: {error}"
    return JobResult("worker_differs", reason, id=job.id)


def fly_job(job: Job) -> JobResult:
    """Fly the job on a dask worker, in the worker process of this thread."""
    for _ in range(ATTEMPTS):
        worker: Worker | None = getattr(_own, "worker", None)
        if worker is None:
            worker = _own.worker = Worker()
        worker.submit(job)
        result = worker.receive()
        if result:
            return result
        worker.close()
        _own.worker = None
    return lost(job)


@contextmanager
def dask_client(address: str, jobs: int) -> Iterator[Any]:
    """Connect to the scheduler at `address`, or start LOCAL with `jobs` workers.

    Raises InputError when dask is not installed or the scheduler cannot be reached.
    """
    try:
        import dask
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise MissingExtraError("--cluster", "dask.distributed", "cluster") from error
    if address == LOCAL:
        with (
            dask.config.set({"distributed.scheduler.allowed-failures": ATTEMPTS - 1}),
            LocalCluster(
                n_workers=jobs,
                threads_per_worker=1,
                host="127.0.0.1",
                dashboard_address="127.0.0.1:0",
            ) as local,
            Client(local) as client,
        ):
            yield client
        return
    try:
        client = Client(address, timeout=_TIMEOUT)
    except (OSError, ValueError) as error:
        raise InputError(f"--cluster {address}: no scheduler reached: {error}") from error
    with client:
        yield client
