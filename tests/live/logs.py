"""What is left of a recording, and a disk that is full."""

import resource
from pathlib import Path

import numpy as np

from atlas_cueing.recording import read_log
from atlas_cueing.recording.log import Log
from atlas_cueing.review.recovery import Recovered, recover_log


def times(log: Log) -> np.ndarray:
    """Of all ticks, s."""
    return log.column("/timing", "time_s")


def recovered(path: Path) -> tuple[Recovered, Log]:
    """What the .part of the log `path` holds."""
    fixed = path.with_name("fixed.mcap")
    return recover_log(path.with_name(f"{path.name}.part"), fixed), read_log(fixed)


class largest_file:  # noqa: N801 - reads as a function
    """A full disk: no file of this process, or of one forked meanwhile, grows larger than this."""

    def __init__(self, size: int) -> None:
        self._size = size

    def __enter__(self) -> None:
        self._before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (self._size, self._before[1]))

    def __exit__(self, *_: object) -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, self._before)
