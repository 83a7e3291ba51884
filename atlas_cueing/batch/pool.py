"""Runs on this machine: some worker processes, each with one run at a time."""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from selectors import EVENT_READ, DefaultSelector
from types import TracebackType
from typing import Self

from .job import Job
from .job_queue import JobQueue
from .job_result import JobResult

Stop = Callable[[], bool]

ATTEMPTS = 2  # times that a run may lose its worker before it is left
_PATIENCE = 0.2  # s from one look at whether to stop to the next
_GRACE = 10.0  # s for a worker to kill its run and end, once its stdin is closed
# -P: nothing in the working directory is imported
_COMMAND = (sys.executable, "-P", "-m", f"{__package__}.worker_main")
# a process that forks must not have threads
_SINGLE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


class Worker:
    """A worker process: it flies one job at a time; closing it kills the run under way."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(  # noqa: S603 - our own module
            _COMMAND,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, **_SINGLE},
            start_new_session=True,  # Ctrl-C is for the driver, which stops its workers
        )
        # Pipes, as asked for
        assert self._process.stdin and self._process.stdout  # noqa: S101, PT018
        self._jobs, self._results = self._process.stdin, self._process.stdout
        self.job: Job | None = None
        self.losses = 0  # times that the present job lost a worker

    def fileno(self) -> int:
        """Return the file descriptor that is readable when a result can be received."""
        return self._results.fileno()

    @property
    def pid(self) -> int:
        """Return the number of the process."""
        return self._process.pid

    def submit(self, job: Job, losses: int = 0) -> None:
        """Start to fly a job that has already lost `losses` workers."""
        self.job, self.losses = job, losses
        with suppress(OSError):  # it is gone, and `receive` will say so
            self._jobs.write(job.to_line())
            self._jobs.flush()

    def receive(self) -> JobResult | None:
        """Wait for the result of the job; None when the worker died."""
        line = self._results.readline()
        return JobResult.from_json(json.loads(line)) if line.endswith(b"\n") else None

    def close(self) -> None:
        """End the process, and the run under way with it."""
        for pipe in (self._jobs, self._results):
            with suppress(OSError):
                pipe.close()
        try:
            self._process.wait(_GRACE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def fly_here(todo: Iterable[Job], workers: int, stop: Stop = lambda: False) -> Iterator[JobResult]:
    """Fly the jobs in `workers` processes, and yield results as they come.

    Once `stop` is true, runs under way are killed.

    A run that loses its worker is begun again with a new one, and given up as `worker_lost` when
    that is lost, too.
    """
    crew = _Crew(todo)
    try:
        for _ in range(workers):
            crew.hire()
        while crew.busy and not stop():
            yield from crew.results()
    finally:
        crew.dismiss()


class _Crew:
    """Workers, all of them busy, and the jobs that are left."""

    def __init__(self, todo: Iterable[Job]) -> None:
        self._todo = JobQueue(todo)
        self._selector = DefaultSelector()

    @property
    def busy(self) -> bool:
        """Whether a worker is flying a job."""
        return bool(self._selector.get_map())

    def hire(self) -> None:
        """Start a new worker with the next job, if there is one."""
        job = self._next("")
        if job:
            self._begin(job, 0)

    def results(self) -> Iterator[JobResult]:
        """Yield the results that come within a moment, and give those workers the next job."""
        for key, _ in self._selector.select(_PATIENCE):
            worker: Worker = key.data
            result = worker.receive()
            if result:
                self._go_on(worker)
                yield result
            else:
                yield from self._replace(worker)

    def dismiss(self) -> None:
        """Kill every run under way."""
        for key in list(self._selector.get_map().values()):
            self._drop(key.data)
        self._selector.close()

    def _next(self, flight: str) -> Job | None:
        """Give the next job for a worker that last flew `flight`, or nothing yet ("")."""
        workers = [key.data for key in self._selector.get_map().values()]
        return self._todo.next(flight, {each.job.flight for each in workers if each.job})

    def _begin(self, job: Job, losses: int) -> None:
        worker = Worker()
        self._selector.register(worker, EVENT_READ, worker)
        worker.submit(job, losses)

    def _go_on(self, worker: Worker) -> None:
        job = self._next(worker.job.flight if worker.job else "")
        if job:
            worker.submit(job)
        else:
            self._drop(worker)

    def _replace(self, worker: Worker) -> Iterator[JobResult]:
        """Begin the run of a dead worker again, or give it up."""
        self._drop(worker)
        if worker.job and worker.losses + 1 < ATTEMPTS:
            self._begin(worker.job, worker.losses + 1)
        elif worker.job:
            self.hire()
            yield lost(worker.job)

    def _drop(self, worker: Worker) -> None:
        self._selector.unregister(worker)
        worker.close()


def lost(job: Job) -> JobResult:
    """Return the result of a job that lost its worker too often."""
    reason = f"its worker process died {ATTEMPTS} times while flying it"
    return JobResult("worker_lost", reason, id=job.id)
