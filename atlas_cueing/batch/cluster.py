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
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from math import inf
from time import monotonic, sleep
from typing import Any

from ..errors import InputError, MissingExtraError
from .job import Job
from .job_queue import JobQueue
from .job_result import JobResult
from .pool import ATTEMPTS, Stop, Worker, lost

LOCAL = "local"  # in place of an address: a scheduler and workers on 127.0.0.1, for this batch only
_AHEAD = 2  # jobs that wait at a worker beside those that it flies
_LOOK_EVERY = 1.0  # s from one look at who is in the cluster to the next
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

    seats = _Seats(client, todo)
    waiting = as_completed(seats.filled())
    while (waiting.count() or seats.left) and not stop():
        if not waiting.has_ready():
            sleep(_PATIENCE)
            waiting.update(seats.filled())
            continue
        for future in waiting.next_batch(block=True):
            result = _result(future, seats.leave(future.key))
            waiting.update(seats.filled())
            yield result


class _Seats:
    """The dask workers with the jobs that wait at each: a few, of the flight that it has."""

    def __init__(self, client: Any, todo: Iterable[Job]) -> None:
        self._client = client
        self._todo = JobQueue(todo)
        self._flights: dict[str, str] = {}  # worker to the flight of its last job
        self._seated: dict[str, tuple[Job, str]] = {}  # jobs by id, with their worker
        self._threads: dict[str, int] = {}
        self._looked = -inf

    @property
    def left(self) -> bool:
        """Whether there are jobs that nobody has been given."""
        return bool(self._todo)

    def leave(self, name: str) -> Job:
        """Return the job that has been done."""
        return self._seated.pop(name)[0]

    def filled(self) -> list[Any]:
        """Submit jobs for all seats that are free, and return their futures."""
        if monotonic() - self._looked > _LOOK_EVERY:
            self._threads, self._looked = self._client.nthreads(), monotonic()
        waiting = Counter(worker for _, worker in self._seated.values())
        return [
            self._submit(job, worker)
            for worker, threads in self._threads.items()
            for _ in range(_AHEAD + threads - waiting[worker])
            if (job := self._next(worker))
        ]

    def _next(self, worker: str) -> Job | None:
        others = {flight for other, flight in self._flights.items() if other != worker}
        return self._todo.next(self._flights.get(worker, ""), others)

    def _submit(self, job: Job, worker: str) -> Any:
        self._flights[worker] = job.flight
        self._seated[job.id] = (job, worker)
        # The key makes a run that is under way for a driver that was killed be waited for instead
        # of flown twice. The worker is a wish: when it is lost, or others have nothing left to do,
        # the scheduler gives the job to them.
        return self._client.submit(
            fly_job, job, key=job.id, retries=0, workers=[worker], allow_other_workers=True
        )


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
