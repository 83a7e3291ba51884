"""How the messages of a channel are spread over a file, and their order in time."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .wire import Times


class Pieces:
    """How the messages of a channel are spread over the file: log times (ns), chunk by chunk."""

    def __init__(self) -> None:
        """No messages yet."""
        self._times = bytearray()
        self._sizes: list[int] = []
        self._loose = False

    def add(self, times: Times, *, loose: bool) -> None:
        """Add the log times of the next chunk; `loose` messages, outside of chunks, are one piece."""
        self._times += np.ascontiguousarray(times).data.cast("B")
        if loose and self._loose:
            self._sizes[-1] += len(times)
        else:
            self._sizes.append(len(times))
        self._loose = loose

    def times(self) -> Times:
        """All log times (n,), ns, in the order of the file."""
        return np.frombuffer(self._times, np.uint64)

    def order(self) -> NDArray[np.intp]:
        """Rows (n,) in order of time: chunks that another writer put in another order change places.

        Within a chunk, and where chunks overlap, the order of the file stays, so that ticks which
        were recorded in the wrong order are found.
        """
        times, ends = self.times(), np.cumsum(self._sizes)
        parts = [np.arange(end - size, end) for size, end in zip(self._sizes, ends, strict=True) if size]
        ordered = sorted(parts, key=lambda part: (int(times[part].min()), int(part[0])))
        bounds = [(int(times[part].min()), int(times[part].max())) for part in ordered]
        apart = all(before[1] <= after[0] for before, after in pairwise(bounds))
        return np.concatenate([np.empty(0, np.intp), *(ordered if apart else parts)])


def merged_order(channels: Sequence[Pieces]) -> NDArray[np.intp]:
    """Rows of all channels, one after the other, in order of log time; each channel keeps its own order."""
    rows, keys, start = [np.empty(0, np.intp)], [np.empty(0, np.uint64)], 0
    for pieces in channels:
        order, times = pieces.order(), pieces.times()
        rows.append(start + order)
        keys.append(np.maximum.accumulate(times[order]))
        start += len(times)
    return np.concatenate(rows)[np.argsort(np.concatenate(keys), kind="stable")]
