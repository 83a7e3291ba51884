"""Figures of a run, computed from its logged columns in one pass.

Metrics say how good the cueing was (`Metrics`; every one is declared in `metric_table`), `LimitUse`
whether the actuators' limits were kept, `Consistency` whether the log can be trusted.

Why in blocks: a run is evaluated while it is recorded. An hour at 1 kHz has columns of 2 GB,
which a batch would hold once for each core; in blocks it takes one block's memory, and what
quantiles need. So no class here sees a whole run. Each has the same three methods (`Figures`):

    class PeakRate:
        def __init__(self) -> None:                       # a run without ticks
            self._largest = 0.0

        def add(self, block: RunColumns) -> None:         # the next ticks, at least one
            self._largest = max(self._largest, float(np.max(length(block.felt_w))))

        def figures(self) -> dict[str, float]:            # of all blocks so far
            return {"peak_rate_rad_s": self._largest}

What a class may keep between blocks: sums and peaks (`statistics`), the last rows, so that
differences go on across the cut (`Tail`), and the state of a filter (`vestibular.Sensing`). Only
quantiles keep all values, 4 bytes a tick (`Spread`). What a figure is does not depend on where a
run is cut, up to rounding; to the last bit it is the same in blocks of `BLOCK_TICKS`, which
recorder and review both use (`gathered`).
"""

from .consistency import Consistency
from .contact_loads import ContactLoads, load_violations, traction_lines, traction_lost
from .engaged_segment import engaged_segment
from .limit_use import LimitUse, by_limit, violations
from .metric import Cell, Metric, Phrase, Shown
from .metrics import DECLARED, Metrics, shown
from .ratio import mismatch_ratio
from .run_columns import BLOCK_TICKS, Columns, RunColumns, gathered

__all__ = [
    "BLOCK_TICKS",
    "DECLARED",
    "Cell",
    "Columns",
    "Consistency",
    "ContactLoads",
    "LimitUse",
    "Metric",
    "Metrics",
    "Phrase",
    "RunColumns",
    "Shown",
    "by_limit",
    "engaged_segment",
    "gathered",
    "load_violations",
    "mismatch_ratio",
    "shown",
    "traction_lines",
    "traction_lost",
    "violations",
]
