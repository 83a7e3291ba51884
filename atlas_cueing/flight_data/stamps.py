"""Time stamps put in order: repeated and late ones, and where there are gaps.

Stamps of others jitter, repeat, come late, and have holes. What can be told from them is kept: a
repeated stamp has the mean of its values, a sample that came late goes where its stamp says, and a
hole of GAP or more is a gap, which nobody may fill.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..rotations import Array
from .samples import Samples, Stamps

GAP = 0.2  # s; a rider feels what happens in that time
_ROUNDED = 1e-6  # s, of stamps
_MOST_DIGITS, _FEWEST_SIGNIFICANT = 9, 5
_LEAST = 8  # samples that a fit needs


@dataclass(frozen=True, slots=True)
class Series:
    """Samples of one part in the order of time.

    time: (n,) s since the file's first stamp, strictly increasing. values: (n, columns).
    index: (n,) which of the samples each one is, for messages. samples: as they were read.
    rounding: (n,) s, how far the time may lie from the true one because it was rounded.
    repeated, late: how many stamps were.
    """

    time: Array
    values: Array
    index: NDArray[Any]
    samples: Samples
    rounding: Array
    repeated: int
    late: int

    def place(self, k: int) -> str:
        """Where sample k stands in the file, for messages."""
        return self.samples.place(int(self.index[k]))

    def gaps(self) -> list[tuple[int, int]]:
        """Return the pairs of samples, by number, between which there is a gap."""
        before = np.flatnonzero(np.diff(self.time) > GAP - _ROUNDED)
        return [(int(k), int(k) + 1) for k in before]

    def between(self, begin: float, end: float) -> "Series":
        """Return the samples from `begin` to `end`, s, both included."""
        first = int(np.searchsorted(self.time, begin, side="left"))
        last = int(np.searchsorted(self.time, end, side="right"))
        part = slice(first, last)
        return replace(
            self,
            time=self.time[part],
            values=self.values[part],
            index=self.index[part],
            rounding=self.rounding[part],
        )


def origin(parts: list[Samples]) -> int | float:
    """Return the earliest stamp of a file, in the unit of its stamps."""
    earliest = min(samples.stamps.min() for samples in parts)
    return int(earliest) if isinstance(earliest, np.integer) else float(earliest)


def in_order(path: str, samples: Samples, start: int | float, unit: float) -> Series:
    """Return samples in the order of time.

    Args:
        path: of the file, for messages.
        samples: as they were read.
        start: stamp of time 0; it is taken off before anything is rounded.
        unit: of the stamps, s.

    Raises InputError where time goes back by a gap or more, where a value is missing or not finite,
    and for too few samples.
    """
    _check_values(path, samples)
    time = _seconds(samples.stamps, start, unit)
    _check_times(path, samples, time)
    order = np.argsort(time, kind="stable")
    late = int(np.count_nonzero(np.diff(time) < 0.0))
    time, values = time[order], samples.values[order]
    first = np.concatenate([[True], np.diff(time) > 0.0])
    starts = np.flatnonzero(first)
    counts = np.diff([*starts.tolist(), len(time)])
    repeated = len(time) - len(starts)
    if repeated:
        values = np.add.reduceat(values, starts, axis=0) / counts[:, None]
        time, order = time[starts], order[starts]
    if len(time) < _LEAST:
        raise InputError(
            f"{path}: {len(time)} samples of {', '.join(samples.columns)} with times of their own,"
            f" allowed: at least {_LEAST}"
        )
    rounding = unit * _rounding(samples.stamps[order])
    return Series(time, values, order, samples, rounding, repeated, late)


def _seconds(stamps: Stamps, start: int | float, unit: float) -> Array:
    """Return times in s; whole numbers are subtracted as such, so that no digit is lost."""
    since = stamps - (int(start) if stamps.dtype.kind in "ui" else float(start))
    seconds = since.astype(np.float64)
    # 1e-6 has no exact double, 1e6 has
    scaled: Array = seconds / round(1.0 / unit) if unit < 1.0 else seconds * unit
    return scaled


def _rounding(stamps: Stamps) -> Array:
    """Return half of the last digit that each stamp is written with, in the unit of the stamps.

    Digits after the point are counted, or else significant ones, as JSBSim and C write six.
    """
    if stamps.dtype.kind in "ui":
        return np.full(len(stamps), 0.5)
    written = stamps.astype(np.float64)
    decimals = next((d for d in range(_MOST_DIGITS) if _is_same(written.round(d), written)), None)
    if decimals is not None:
        return np.full(len(stamps), 0.5 * 10.0**-decimals)
    with np.errstate(divide="ignore"):
        leading = np.floor(np.log10(np.maximum(np.abs(written), 1e-12)))
    for digits in range(_FEWEST_SIGNIFICANT, _MOST_DIGITS):
        last = 10.0 ** (leading - digits + 1)
        if _is_same(last * np.rint(written / last), written):
            half: Array = 0.5 * last
            return half
    return np.zeros(len(stamps))


def _is_same(rounded: Array, stamps: Array) -> bool:
    return bool(np.all(np.abs(rounded - stamps) <= 1e-14 * np.maximum(np.abs(stamps), 1e-3)))


def _check_values(path: str, samples: Samples) -> None:
    wrong = np.argwhere(~np.isfinite(samples.values))
    if len(wrong):
        row, column = wrong[0]
        raise InputError(
            f"{path}: {samples.place(row)}: {samples.columns[column]} ="
            f" {samples.values[row, column]:g}, allowed: a finite number, or none in all of"
            f" {', '.join(samples.columns)}"
        )


def _check_times(path: str, samples: Samples, time: Array) -> None:
    steps = np.diff(np.maximum.accumulate(time)) if len(time) else time
    back = time[1:] - np.maximum.accumulate(time)[:-1] if len(time) > 1 else steps
    wrong = np.flatnonzero(~(back > -GAP))
    if len(wrong):
        k = int(wrong[0]) + 1
        raise InputError(
            f"{path}: {samples.place(k)}: {samples.time} goes back by {-back[k - 1]:.6g} s, to"
            f" {time[k]:.6f} s after the first, allowed: less than {GAP:g} s (a sample that came"
            " late)"
        )
