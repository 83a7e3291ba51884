"""All metrics of a run, and the declaration of each by its name."""

from itertools import chain

from .conditional_metrics import CONSISTENCY, CONTACT_LOADS, RELATIVE
from .metric import Metric, Shown
from .metric_table import METRICS
from .run_columns import Figures, RunColumns

DECLARED: dict[str, Metric] = {
    metric.name: metric
    for metric in (
        *RELATIVE,
        *chain.from_iterable(METRICS.values()),
        *CONSISTENCY,
        *CONTACT_LOADS,
    )
}
"""Every declared metric by its name: those that need another run first, then all others in the
order in which a run gives them."""


class Metrics:
    """All metrics of a run but those of `Consistency` and `ContactLoads`, which need the platform.

    Every metric is a finite float when the columns are finite (and no wilder than
    `perceived.LARGEST`), and 0 for a run without ticks.
    """

    def __init__(self) -> None:
        """Begin without ticks, with one of each class in `METRICS`."""
        self._parts: list[Figures] = [part() for part in METRICS]

    def add(self, block: RunColumns) -> None:
        """Take in the next ticks, at least one."""
        for part in self._parts:
            part.add(block)

    def figures(self) -> dict[str, float]:
        """All metrics of the ticks so far, in the order of `DECLARED`."""
        return {name: value for part in self._parts for name, value in part.figures().items()}


def shown(place: Shown) -> list[Metric]:
    """The metrics that are shown at a place, in the order of `DECLARED`."""
    return [metric for metric in DECLARED.values() if metric.shown & place]
