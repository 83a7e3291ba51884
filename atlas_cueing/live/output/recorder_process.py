"""The recorder of a live run in a process of its own, which a slow disk may hold up."""

import json
from dataclasses import asdict
from time import monotonic, sleep

from ...recording import McapRecorder
from ...telemetry import Ring
from ...telemetry.child_process import ChildProcess, Left, ProcessExit
from .ring_recorder import Recorded, RingRecorder

POLL_S = 0.01  # s between two reads of the ring
# s that the last chunks may take to a slow, busy disk (assumed); the platform is at rest by then
FINISH_S = 60.0


class RecorderProcess:
    """Writes the log of what goes into a ring from now on.

    The log is finished when END is in the ring. If the loop's process ends without, however it
    ends, the log is finished with the result `loop_killed`. If this process is killed, the log's
    .part has all but the last 0.1 s, for `recover`.
    """

    def __init__(self, ring: Ring, recorder: McapRecorder, *, announce: bool = False) -> None:
        """Fork the recorder.

        Args:
            ring: written by this process only.
            recorder: open, with `started_ns`; it goes over to the new process.
            announce: report every change of state on stderr.
        """
        follower = RingRecorder(ring, recorder, announce=announce)
        self._process = ChildProcess(lambda left: _follow(follower, left))
        recorder.abandon()

    @property
    def pid(self) -> int:
        """Process id of the recorder."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether it records; False in mid-run means that it was killed or failed.

        Takes a microsecond or so.
        """
        return self._process.alive

    def finish(self, timeout: float = FINISH_S) -> Recorded:
        """Wait for the finished log, at most `timeout` s.

        After that the process is killed and the log stays a .part. END should be in the ring
        before. A second call is harmless.
        """
        ended = self._process.finish(timeout)
        if ended.answer:
            return Recorded(**json.loads(ended.answer))
        return Recorded(
            "recorder_died", f"{_describe(ended)}; the log is a .part: atlas-cueing recover", 0, 0
        )


def _follow(recorder: RingRecorder, left: Left) -> bytes:
    """Record until the end, or until nothing more can come."""
    while True:
        # before the ring is read: what the loop wrote until its end is then in there
        last = left()
        recorded = recorder.step(monotonic())
        if recorded is None and last:
            recorded = recorder.orphaned()
        if recorded is not None:
            return json.dumps(asdict(recorded)).encode()
        sleep(POLL_S)


def _describe(ended: ProcessExit) -> str:
    kind = "signal" if ended.status < 0 else "exit status"
    return f"the recorder's process ended with {kind} {abs(ended.status)}"
