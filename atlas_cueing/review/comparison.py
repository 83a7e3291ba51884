"""Reviews of several logs of one flight, side by side."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..evaluation import DECLARED, Metric, mismatch_ratio
from .recorded_run import RecordedRun
from .verdict import Review, review_log

STILL = "still"  # the method that a mismatch ratio is to


@dataclass(frozen=True, slots=True)
class Comparison:
    """Reviews of several logs, with a short name for each.

    Where one of them is by method `still`, the metrics of those of the same flight on the same
    platform have their mismatch_ratio to it.
    """

    names: tuple[str, ...]
    reviews: tuple[Review, ...]

    @property
    def clean(self) -> bool:
        """Whether nothing was found in any log."""
        return all(each.clean for each in self.reviews)

    def metrics(self) -> list[Metric]:
        """Every metric that any log has, in the order of their declaration."""
        return [
            metric
            for name, metric in DECLARED.items()
            if any(name in each.metrics for each in self.reviews)
        ]

    def to_json(self) -> dict[str, object]:
        """The reviews by log, and every metric as a list in the order of the logs.

        The list has None where a log lacks the metric.
        """
        return {
            "names": list(self.names),
            "logs": [
                {key: value for key, value in each.to_json().items() if key != "metrics"}
                for each in self.reviews
            ],
            "metrics": {
                metric.name: [each.metrics.get(metric.name) for each in self.reviews]
                for metric in self.metrics()
            },
        }


def compare_logs(paths: Sequence[str | Path], *, different_flights: bool = False) -> Comparison:
    """Review every log and put the figures side by side.

    Raises InputError for fewer than two logs, or when the vehicle did not fly the same in all and
    `different_flights` is not given; LogError for a log that cannot be read.
    """
    if len(paths) < 2:
        raise InputError(f"compare needs at least two logs; got {len(paths)}")
    reviews = tuple(review_log(path) for path in paths)
    for other in reviews[1:]:
        difference = flights_differ(reviews[0].run, other.run)
        if difference and not different_flights:
            raise InputError(
                f"{other.run.log.path} is another flight than {reviews[0].run.log.path}:"
                f" {difference}; to compare them all the same use --different-flights"
            )
    return Comparison(_names(reviews), tuple(_beside_still(each, reviews) for each in reviews))


def _beside_still(ride: Review, reviews: Sequence[Review]) -> Review:
    """The review with its mismatch ratio, as it is without a ride by `still` to compare it with."""
    for mark in reviews:
        if mark.run.log.metadata.get("method") == STILL and _same_but_the_cabin(ride.run, mark.run):
            ratio = mismatch_ratio(ride.metrics["mismatch"], mark.metrics["mismatch"])
            return replace(ride, metrics={**ride.metrics, "mismatch_ratio": ratio})
    return ride


def _same_but_the_cabin(one: RecordedRun, other: RecordedRun) -> bool:
    """Whether both rode the same flight on the same platform."""
    return one.platform == other.platform and not flights_differ(one, other)


def flights_differ(one: RecordedRun, other: RecordedRun) -> str:
    """Say in what two flights of the vehicle differ; "" when they are equal to the last bit."""
    a, b = one.flight, other.flight
    if len(a.time) != len(b.time):
        return f"{len(b.time)} ticks instead of {len(a.time)}"
    pairs = {
        "time": (a.time, b.time),
        "attitude": (a.vehicle_q_NB, b.vehicle_q_NB),
        "rates": (a.vehicle_w_B, b.vehicle_w_B),
        "specific force": (a.vehicle_f_B, b.vehicle_f_B),
    }
    for name, (x, y) in pairs.items():
        same = np.all(np.reshape((x == y) | (np.isnan(x) & np.isnan(y)), (len(x), -1)), axis=1)
        if not same.all():
            return f"the vehicle's {name} differs from {a.time[int(np.argmin(same))]:.6f} s on"
    return ""


def _names(reviews: Sequence[Review]) -> tuple[str, ...]:
    """Short names: the methods if they differ, else methods and platforms, else the files."""
    metadata = [each.run.log.metadata for each in reviews]
    for keys in (("method",), ("platform",), ("method", "platform"), ("scenario",)):
        names = tuple(" ".join(record.get(key, "?") for key in keys) for record in metadata)
        if len(set(names)) == len(names):
            return names
    stems = tuple(each.run.log.path.stem for each in reviews)
    return (
        stems
        if len(set(stems)) == len(stems)
        else tuple(str(each.run.log.path) for each in reviews)
    )
