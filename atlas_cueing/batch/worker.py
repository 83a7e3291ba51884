"""A process that has everything imported and forks once for each run: `python -m atlas_cueing.batch.worker`.

Orders come in on stdin, a line each, and records go out on stdout, a line each. A run costs a fork instead of an interpreter
with its libraries, and takes nothing with it when it crashes, hangs or eats memory. When stdin ends, the run under way is
killed: a driver that is gone leaves nothing behind.
"""

import gc
import json
import os
import signal
import sys
import tempfile
from pathlib import Path
from select import select
from time import monotonic
from typing import BinaryIO

import numpy.fft  # noqa: F401 - numpy loads it when it is first used, which would be in every child

from .alone import confine, fly_alone
from .order import Order
from .record import Record, keep

_PIECE = 65536  # bytes read at a time
_TAIL = 300  # characters of what a crashed run printed last, for its reason


def main() -> None:
    """Serve until stdin ends."""
    replies = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # whatever a library prints must not get among the records
    gc.collect()
    gc.freeze()  # so that children do not copy what they never change
    while line := sys.stdin.buffer.readline():
        order = Order.from_line(line)
        record = isolated(order)
        if record is None:
            return
        replies.write(json.dumps(record.to_json()).encode() + b"\n")
        replies.flush()


def isolated(order: Order) -> Record | None:
    """Fly the order in a child; its own record, or one that says how it died. None when stdin ended meanwhile."""
    begun = monotonic()
    with tempfile.TemporaryFile() as printed:
        reading, writing = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(reading)
            _fly_and_exit(order, writing, printed)
        os.close(writing)
        told, ended = _listen(reading, begun + order.limits.time)
        os.close(reading)
        if not ended:
            os.kill(child, signal.SIGKILL)
        _, status = os.waitpid(child, 0)
        if ended and told:
            return Record.from_json(json.loads(told))
        if ended is None:
            return None
        result, reason = _cause(order, status, printed) if ended else ("timed_out", f"not over after {order.limits.time:g} s")
    part = f"{order.id}.mcap.part"
    left = part if (Path(order.folder) / part).is_file() else ""
    record = Record(order.id, result, reason, left, wall=monotonic() - begun)
    keep(record, Path(order.folder))
    return record


def _listen(reading: int, deadline: float) -> tuple[bytes, bool | None]:
    """What the child told until it ended; False when the deadline passed, None when stdin ended."""
    told = bytearray()
    while (left := deadline - monotonic()) > 0.0:
        ready, _, _ = select([reading, 0], [], [], left)
        if reading in ready:
            piece = os.read(reading, _PIECE)
            if not piece:
                return bytes(told), True
            told += piece
        elif ready:
            return b"", None
    return b"", False


def _fly_and_exit(order: Order, writing: int, printed: BinaryIO) -> None:
    """The child: never returns."""
    status = 1
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        with open(os.devnull) as nothing:  # the worker's stdin is for orders
            os.dup2(nothing.fileno(), 0)
        os.dup2(printed.fileno(), 1)
        os.dup2(printed.fileno(), 2)
        confine(order.limits.memory)
        told = json.dumps(fly_alone(order).to_json()).encode()
        while told:
            told = told[os.write(writing, told) :]
        status = 0
    except BaseException as error:  # noqa: BLE001 - the parent's code must not go on in the child
        os.write(2, f"{type(error).__name__}: {error}".encode())
    finally:
        os._exit(status)


def _cause(order: Order, status: int, printed: BinaryIO) -> tuple[str, str]:
    """Result and reason of a child that ended without a word."""
    printed.seek(0)
    last = " ".join(printed.read().decode(errors="replace").split())[-_TAIL:]
    code = os.waitstatus_to_exitcode(status)
    how = f"ended by {signal.Signals(-code).name}" if code < 0 else f"ended with exit status {code}"
    if "bad_alloc" in last or "MemoryError" in last:
        return "out_of_memory", f"needs more than {order.limits.memory:g} GB: {how}"
    return "crashed", f"{how}{': ' if last else ''}{last}"


if __name__ == "__main__":
    main()
