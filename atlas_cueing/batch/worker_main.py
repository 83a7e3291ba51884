"""A worker: everything is imported once, and each run costs a fork.

It is started as `python -m atlas_cueing.batch.worker_main`.

Orders come in on stdin, a line each, and records go out on stdout, a line each. A run costs a fork
instead of an interpreter with its libraries, and takes nothing with it when it crashes, hangs or
eats memory. When stdin ends, the run under way is
killed: a driver that is gone leaves nothing behind.
"""

import gc
import json
import os
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from time import monotonic

import numpy.fft  # noqa: F401 - numpy loads it when it is first used, which would be in every child

from ..errors import OutputError
from .execute import confine, fly_alone, left_by
from .isolation import ChildExit, in_child
from .job import Job
from .job_result import JobResult, done_by_another, keep
from .store import ResultStore, open_store


def main() -> None:
    """Serve until stdin ends."""
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever a library prints must not get among the records
    gc.collect()
    gc.freeze()  # so that children do not copy what they never change
    with suppress(EOFError):
        while line := sys.stdin.buffer.readline():
            record = isolated(Job.from_line(line))
            replies.write(json.dumps(record.to_json()).encode() + b"\n")
            replies.flush()


def isolated(order: Job) -> JobResult:
    """Fly the order in a child, and deliver its log and record.

    One that died gets a record that says how.

    A run that was done meanwhile is not flown again: a cluster may order it twice when it loses a
    worker or the driver. Raises EOFError when stdin ends meanwhile.
    """
    results = open_store(order.place)
    try:
        # What a killed child leaves in `scratch` goes with it.
        with (
            results.claimed(order.id),
            tempfile.TemporaryDirectory(prefix="atlas_cueing_") as scratch,
        ):
            return _flown(order, results, Path(scratch))
    except (OSError, OutputError) as error:
        return JobResult("recording_failed", f"{order.id}: {error}", id=order.id)


def _flown(order: Job, results: ResultStore, scratch: Path) -> JobResult:
    workdir = results.workdir(scratch)

    def work() -> bytes:
        """The flight, as the child tells it."""
        tempfile.tempdir = str(scratch)
        confine(order.limits.memory)
        done = done_by_another(order.id, results)
        return json.dumps([done is None, (done or fly_alone(order, workdir)).to_json()]).encode()

    begun = monotonic()
    ended = in_child(work, order.limits.time)
    if ended.told and not ended.late:
        new, told = json.loads(ended.told)
        record = JobResult.from_json(told)
    else:
        result, reason = _cause(order, ended)
        log, wall, new = left_by(order, workdir), monotonic() - begun, True
        record = JobResult(result, reason, log, wall=wall, id=order.id)
    if new and record.final:
        _deliver(record, workdir, results)
    return record


def _cause(order: Job, ended: ChildExit) -> tuple[str, str]:
    """Result and reason of a child that ended without a word."""
    if ended.late:
        return "timed_out", f"not over after {order.limits.time:g} s"
    if "bad_alloc" in ended.printed or "MemoryError" in ended.printed:
        return (
            "out_of_memory",
            f"needs more than {order.limits.memory:g} GB: {ended.how().split(':')[0]}",
        )
    return "crashed", ended.how()


def _deliver(record: JobResult, workdir: Path, results: ResultStore) -> None:
    """Log and record to where they belong. Raises OSError or OutputError."""
    keep(record, workdir)
    # the record says that all is there
    results.deliver(workdir, [str(name) for name in (record.log, f"{record.id}.json") if name])


if __name__ == "__main__":
    main()
