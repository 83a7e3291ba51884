"""A simulated platform in a process of its own, at a port of the loopback."""

import os
import select
import socket
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from time import monotonic_ns

import numpy as np

from ..errors import InputError
from ..rotations import Array
from ..scenario import Platform
from ..telemetry.child_process import ChildProcess, Left
from .control.pose import Pose
from .output.ring_recorder import report_on_stderr
from .output.sealing import Address
from .output.setpoint import SIZE
from .plant_drives import PlantDrives

_CYCLE_S = 0.002  # s from one look at the clock to the next
_NICE = -15  # below the loop's own priority, and before all else
_FINISH_S = 20.0  # s that the rows may take to a slow disk (assumed)


class PlantProcess:
    """Drives with a plant behind them, until the ride is over.

    address: of the set points, HOST:PORT.
    """

    def __init__(self, platform: Platform, pose: Pose, *, priority: bool = False) -> None:
        """Listen, and fork. With `priority` it runs before others where the system lets it.

        Raises InputError for a platform that makes no plant, or without a free port.
        """
        drives = PlantDrives(platform, monotonic_ns(), pose)
        self._folder = tempfile.TemporaryDirectory(prefix="plant_")
        self._file = Path(self._folder.name) / "rows.npy"
        packets = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        packets.setblocking(False)
        try:
            packets.bind(("127.0.0.1", 0))
        except OSError as error:
            packets.close()
            raise InputError(f"no port of the loopback for the plant: {error}") from error
        host, port = packets.getsockname()
        self.address = f"{host}:{port}"
        with packets:
            self._process = ChildProcess(
                lambda left: _follow(drives, packets, self._file, left, priority=priority)
            )

    def finish(self) -> Array:
        """End it; return the rows of `PlantDrives`, none if it has died, and on a second call."""
        ended = self._process.finish(_FINISH_S)
        if ended.status:
            report_on_stderr(f"the simulated platform has died, with {ended.status}: no /plant")
        with self._folder:
            return np.load(self._file) if self._file.exists() else np.empty((0, 0))


def _follow(
    drives: PlantDrives, packets: socket.socket, file: Path, left: Left, *, priority: bool
) -> bytes:
    """Carry the plant along in real time; what has come is taken before it catches up."""
    told = ""
    if priority:
        with suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, 0, _NICE)
    while not left():
        select.select([packets], [], [], _CYCLE_S)
        for packet, sender in _waiting(packets):
            drives.take(packet, sender)
        for packet, loop in drives.go_on(monotonic_ns()):
            with suppress(OSError):  # the loop has ended
                packets.sendto(packet, loop)
        state, reason = drives.receiver.state
        if state in ("stopping", "latched") and reason != told:
            told = reason
            report_on_stderr(f"plant: drives {state}: {reason}")
    np.save(file, drives.rows)
    return b""


def _waiting(packets: socket.socket) -> Iterator[tuple[bytes, Address]]:
    """Yield the packets that have come, each with its sender."""
    with suppress(BlockingIOError):
        while True:
            yield packets.recvfrom(SIZE + 1)
