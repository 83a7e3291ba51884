"""A worker: everything is imported once, and each run costs a fork.

It is started as `python -m atlas_cueing.batch.worker_main`.

Jobs come in on stdin, a line each, and results go out on stdout, a line each. A run costs a fork
instead of an interpreter with its libraries, and harms no other run when it crashes, hangs or uses
up memory. A flight that a run flew to its end is kept, and ridden by the runs that follow: what a
vehicle does depends on nothing that rides it. When stdin ends, the run under way is killed: a
driver that has ended leaves nothing behind.
"""

import gc
import json
import os
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from time import monotonic

from ..errors import OutputError
from ..vehicles import flight_of_bytes
from .execute import OneFlight, confine, fly_alone, left_by
from .isolation import ChildExit, in_child
from .job import Job
from .job_result import JobResult, done_by_another, keep
from .kept_flights import KeptFlights
from .store import ResultStore, open_store
from .warm_up import warm_up

_RARELY = 200_000  # objects made between two garbage collections: a ride leaves no cycles
_FLIGHT = ".flight"  # what a child leaves for the runs that follow


def main() -> None:
    """Serve until stdin ends."""
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints must not get among the results
    flights = KeptFlights()
    warm_up()
    gc.collect()
    gc.freeze()  # so that children do not copy what they never change
    gc.set_threshold(_RARELY)
    with suppress(EOFError):
        while line := sys.stdin.buffer.readline():
            result = isolated(Job.from_line(line), flights)
            replies.write(json.dumps(result.to_json()).encode() + b"\n")
            replies.flush()


def isolated(job: Job, flights: KeptFlights) -> JobResult:
    """Fly the job in a child process, and deliver its log and result.

    flights: those that are kept; that of the job is among them afterwards if it came to its end.

    The result of a child that died says how it died. A job that has been done meanwhile is not
    flown again: a cluster may submit it twice when it loses a worker or the driver. Raises
    EOFError when stdin ends meanwhile.
    """
    store = open_store(job.place)
    try:
        # What a killed child leaves in `scratch` goes with it.
        with (
            store.claimed(job.id),
            tempfile.TemporaryDirectory(prefix="atlas_cueing_") as scratch,
        ):
            return _flown(job, store, Path(scratch), flights)
    except (OSError, OutputError) as error:
        return JobResult("recording_failed", f"{job.id}: {error}", id=job.id)


def _flown(job: Job, store: ResultStore, scratch: Path, flights: KeptFlights) -> JobResult:
    workdir = store.workdir(scratch)
    flight = OneFlight(flights.get(job.flight), flights.capacity if job.flight else 0)
    kept = scratch / _FLIGHT

    def work() -> bytes:
        """Return whether the job was flown now, and its result, as JSON."""
        tempfile.tempdir = str(scratch)
        # what is kept, what is written down, and its bytes
        confine(job.limits.memory, 3 * flights.capacity)
        done = done_by_another(job.id, store)
        result = done or fly_alone(job, workdir, flight)
        new = flight.new()
        if new:
            with kept.open("wb") as file:
                file.writelines(new.parts())
        return json.dumps([done is None, result.to_json()]).encode()

    begun = monotonic()
    ended = in_child(work, job.limits.time)
    if ended.answer and not ended.late:
        new, table = json.loads(ended.answer)
        result = JobResult.from_json(table)
        if kept.exists():
            flights.put(job.flight, flight_of_bytes(kept.read_bytes()))
    else:
        cause, reason = _cause(job, ended)
        log, wall, new = left_by(job, workdir), monotonic() - begun, True
        result = JobResult(cause, reason, log, wall=wall, id=job.id)
    if new and result.final:
        _deliver(result, workdir, store)
    return result


def _cause(job: Job, ended: ChildExit) -> tuple[str, str]:
    """Return result and reason of a job whose child process ended without an answer."""
    if ended.late:
        return "timed_out", f"not over after {job.limits.time:g} s"
    if "bad_alloc" in ended.printed or "MemoryError" in ended.printed:
        return (
            "out_of_memory",
            f"needs more than {job.limits.memory:g} GB: {ended.how().split(':')[0]}",
        )
    return "crashed", ended.how()


def _deliver(result: JobResult, workdir: Path, store: ResultStore) -> None:
    """Move log and result to the store. Raises OSError or OutputError."""
    keep(result, workdir)
    # the result comes last: it says that the log is complete
    store.deliver(workdir, [str(name) for name in (result.log, f"{result.id}.json") if name])


if __name__ == "__main__":
    main()
