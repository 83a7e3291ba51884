"""The same flight cued in several ways, side by side."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import InputError
from .recorded_run import RecordedRun
from .verdict import Review, review_log


@dataclass(frozen=True, slots=True)
class Comparison:
    """Reviews of several logs, with a short name for each."""

    names: tuple[str, ...]
    reviews: tuple[Review, ...]

    @property
    def clean(self) -> bool:
        """Nothing was found in any log."""
        return all(each.clean for each in self.reviews)

    def metric_names(self) -> list[str]:
        """Every metric that any log has, in the order of the first one."""
        return list(dict.fromkeys(name for each in self.reviews for name in each.metrics))

    def to_json(self) -> dict[str, object]:
        """One object a log, and every metric as a list in the order of the logs.

        None where a log lacks it.
        """
        return {
            "names": list(self.names),
            "logs": [
                {key: value for key, value in each.to_json().items() if key != "metrics"}
                for each in self.reviews
            ],
            "metrics": {
                name: [each.metrics.get(name) for each in self.reviews]
                for name in self.metric_names()
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
    return Comparison(_names(reviews), reviews)


def flights_differ(one: RecordedRun, other: RecordedRun) -> str:
    """In what the vehicle's flight differs; empty when it is the same to the last bit."""
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
    """The methods, if they tell the logs apart; else methods and platforms; else the files."""
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
