"""How good the cueing was: every figure of a flight."""

from math import inf

import numpy as np

from .actuation import Actuation
from .coriolis import Coriolis
from .cost import cost_of
from .deviation import Deviation
from .fidelity import Fidelity
from .run_columns import RunColumns, gathered


class Metrics:
    """All figures of a flight that comes block by block."""

    def __init__(self) -> None:
        """Of no ticks yet."""
        self._deviation, self._likeness, self._turning, self._effort = (
            Deviation(),
            Fidelity(),
            Coriolis(),
            Actuation(),
        )
        self._ticks, self._first, self._last = 0, inf, -inf

    def add(self, block: RunColumns) -> None:
        """Take in the ticks that follow."""
        for part in (self._deviation, self._likeness, self._turning, self._effort):
            part.add(block)
        self._ticks += len(block.time)
        self._first = float(np.minimum(self._first, np.min(block.time)))
        self._last = float(np.maximum(self._last, np.max(block.time)))

    def figures(self) -> dict[str, float]:
        """Those of `metrics`."""
        deviations = self._deviation.figures()
        return {
            **deviations,
            **cost_of(deviations),
            **self._deviation.extra_rate(),
            **self._likeness.figures(),
            **self._turning.figures(),
            **self._effort.figures(),
            "ticks": float(self._ticks),
            "duration_s": self._last - self._first if self._ticks else 0.0,
        }


def metrics(flight: RunColumns) -> dict[str, float]:
    """All figures of a flight, the most telling first, each with its unit in the name.

    Correlations and turns have none.

    Shares are 0 to 1 of the ticks. The definitions stand with the functions: `deviation` (force,
    direction, rate and attitude error), `cost`, `extra_rate`, `likeness` (perceived errors;
    correlation, delay, missing, false, scaled cues of each axis), `turning` (Coriolis exposure, net
    turns), `effort` (smoothing and actuators); ticks and duration_s close the list.

    Every figure is a finite float when the columns are finite; a flight without ticks gives zeros.
    """
    return gathered(Metrics(), flight)
