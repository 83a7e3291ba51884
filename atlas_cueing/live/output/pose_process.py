"""The last pose of the platform in a file, by a process that outlives a loop that is killed."""

# mypyc: runs every tick

from collections.abc import Sequence
from pathlib import Path
from struct import Struct
from time import monotonic, sleep

from ...errors import OutputError
from ...rotation import Mat3, Quat
from ...signals import StageLimits, Tick, WheelLimits
from ...signals import Timing as TickTiming
from ...telemetry import Ring, RingReader
from ...telemetry.child_process import ChildProcess, Left
from ..control.certified_axis import six_axes
from ..control.command import Command, axes_of, command_from
from ..control.drive_monitor import moves
from ..control.pose import Pose, pose_after_stop
from .pose_file import write_pose
from .ring_recorder import report_on_stderr

POLL_S = 0.02  # s between two looks
WRITE_S = 0.05  # s between two writes while it moves
_FINISH_S = 10.0  # s that the last write may take to a slow disk (assumed)
_NO_TICK = 1e-9  # s
_row = Struct("=4d18d")  # orientation; position, speed, acceleration of the six axes
_SLOTS = 1024


class PoseProcess:
    """Keeps the pose in a file, at most 0.1 s old, from what the loop gives it every tick.

    When the loop ends, however it ends, the pose is where the drives come to rest after its last
    command. It takes commands as drives do and ticks as an output does, and never waits.
    """

    def __init__(
        self,
        file: Path,
        platform: str,
        limits: tuple[WheelLimits, StageLimits],
        sphere_from_wheels: Mat3,
        start: Pose,
    ) -> None:
        """Write the pose at the start, and fork.

        Args:
            file: to keep.
            platform: name of the platform.
            limits: of its wheels and stage.
            sphere_from_wheels: J.
            start: where it stands.

        Raises OutputError when the file cannot be written.
        """
        write_pose(file, start, platform, moving=False)
        self._ring = Ring(_SLOTS, _row.size)
        self._command: Command | None = None
        follower = _Follower(file, platform, limits, sphere_from_wheels, RingReader(self._ring))
        self._process = ChildProcess(follower.follow)

    @property
    def pid(self) -> int:
        """Process id of the one that writes."""
        return self._process.pid

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:  # noqa: ARG002
        """Take the command of a tick (`loop.Drives`)."""
        self._command = command
        return True

    def tick(self, tick: Tick, timing: TickTiming) -> None:  # noqa: ARG002
        """Take the tick of the same command (`loop.Output`)."""
        if self._command:
            states = (x for state in axes_of(self._command) for x in state)
            self._ring.write(1, _row.pack(*tick.motion.q_WS, *states))

    def status(self, time: float, state: str, reason: str) -> None:
        """Take a change of state (`loop.Output`), which is no part of a pose."""

    def finish(self) -> str:
        """Wait for the last write; return why the file is not up to date, or ''."""
        ended = self._process.finish(_FINISH_S)
        if ended.status:
            return f"the process that keeps the pose ended with {ended.status}"
        return ended.answer.decode(errors="replace")


class _Follower:
    """The process's own side."""

    def __init__(
        self,
        file: Path,
        platform: str,
        limits: tuple[WheelLimits, StageLimits],
        sphere_from_wheels: Mat3,
        reader: RingReader,
    ) -> None:
        self._file, self._platform, self._reader = file, platform, reader
        self._axes, self._J = six_axes(_NO_TICK, *limits), sphere_from_wheels
        self._written, self._failure = b"", ""
        self._next = 0.0

    def follow(self, left: Left) -> bytes:
        """Write until the loop has ended; return why that failed, if it did."""
        newest = b""
        while True:
            last = left()  # before the ring is read: what the loop wrote is then in there
            for _, row in self._reader.messages():
                newest = row
            if last:
                self._write(newest, stopped=True)
                return self._failure.encode()
            if newest != self._written and monotonic() >= self._next:
                self._write(newest, stopped=False)
                self._written, self._next = newest, monotonic() + WRITE_S
            sleep(POLL_S)

    def _write(self, row: bytes, *, stopped: bool) -> None:
        """Write the pose of a row, or of the stop that follows it; tell the first failure."""
        if not row:
            return
        q_WS, command = _unpacked(_row.unpack(row))
        moving = moves(command) and not stopped
        pose = Pose(q_WS, command.wheel_angle, command.p_WS_W)
        if stopped:
            pose = pose_after_stop(q_WS, command, self._axes, self._J)
        try:
            write_pose(self._file, pose, self._platform, moving=moving)
        except OutputError as error:
            if not self._failure:
                report_on_stderr(f"the pose is not kept: {error}")
            self._failure = str(error)
        else:
            self._failure = ""


def _unpacked(numbers: Sequence[float]) -> tuple[Quat, Command]:
    """Return orientation and command of a row."""
    w, x, y, z, *rest = numbers
    axes = [(rest[k], rest[k + 1], rest[k + 2]) for k in range(0, 18, 3)]
    return (w, x, y, z), command_from(0.0, axes)
