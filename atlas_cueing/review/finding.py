"""A fault found in a log: which check, where, when, how much, and what is allowed."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..rotations import Array


@dataclass(frozen=True, slots=True)
class Finding:
    """One fault of a log.

    check: the rule that is broken, a word or two; place: topic and quantity; time: where it is
    worst, s, None when it belongs to the whole log; text: the evidence.
    """

    check: str
    place: str
    time: float | None
    text: str

    def __str__(self) -> str:
        when = "" if self.time is None else f"{self.time:.6f} s "
        return f"{when}{self.place}: {self.check}: {self.text}"

    def to_json(self) -> dict[str, object]:
        """The fields by name; `time_s` is None when the finding belongs to the whole log."""
        return {"check": self.check, "place": self.place, "time_s": self.time, "text": self.text}


def exceeding(
    check: str,
    places: Sequence[str],
    time: Array,
    values: Array,
    allowed: ArrayLike,
    unit: str,
    *,
    quantity: str = "|value|",
) -> list[Finding]:
    """Make a finding of each column whose magnitude exceeds its bound anywhere, at the worst tick.

    check: the rule; places: name of each column; time: of the ticks (n,), s; values: (n,) or
    (n, k); allowed: bound in `unit`, which broadcasts against (n, k); quantity: how the magnitude
    is called in the text. NaN is not counted here: `finite` has found it already.
    """
    size = np.abs(np.atleast_2d(values.T).T)
    bounds = np.broadcast_to(np.asarray(allowed, dtype=np.float64), size.shape)
    found = []
    for k in np.flatnonzero((size > bounds).any(axis=0)).tolist():
        beyond = size[:, k] > bounds[:, k]
        worst = int(
            np.argmax(np.where(beyond, size[:, k] / np.maximum(bounds[:, k], 1e-300), -1.0))
        )
        value, bound = (f"{number[worst, k]:.9g} {unit}".rstrip() for number in (size, bounds))
        text = f"{quantity} = {value}, allowed: {quantity} <= {bound}"
        found.append(Finding(check, places[k], float(time[worst]), f"{text}{_ticks(beyond, time)}"))
    return found


def _ticks(beyond: NDArray[np.bool_], time: Array) -> str:
    count, first = int(beyond.sum()), float(time[int(np.argmax(beyond))])
    return f" (the worst of {count} ticks, the first at {first:.6f} s)" if count > 1 else ""
