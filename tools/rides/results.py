"""The results: figures of every flight by every method, set by set."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from .figures import STILL, Figures, figures, means, paired, worse
from .flying import Order, Ride

MOST_WORSE = 1.05
"""R above which on any flight a method cannot be the default."""


@dataclass(frozen=True)
class FlightSet:
    """Figures of a set of flights: by flight, then by method; every flight has every method."""

    name: str
    used_for: str
    flights: Mapping[str, Mapping[str, Figures]]

    def of(self, method: str) -> list[Figures]:
        """The figures of a method, flight by flight."""
        return [by_method[method] for by_method in self.flights.values()]

    def summary(self, method: str) -> dict[str, float]:
        """Means, and how many flights are worse than by `still`, and the most."""
        count, most = worse(self.of(method))
        return {**means(self.of(method)), "worse_than_still": count, "most": most}

    def beside(self, method: str, other: str) -> dict[str, Any]:
        """A method beside another: paired ratios of R and R3."""
        return {
            name: asdict(paired(*([getattr(f, name) for f in self.of(m)] for m in (method, other))))
            for name in ("R", "R3")
        }

    def disputed(self, method: str, other: str) -> list[str]:
        """Flights on which M and the observer disagree about which of two methods is better.

        Both by more than 5 %: on the rest one of them has no opinion.
        """
        pairs = {flight: (f[method], f[other]) for flight, f in self.flights.items()}
        return [
            flight
            for flight, (one, two) in pairs.items()
            if _opinion(one.M, two.M) * _opinion(one.observed, two.observed) < 0
        ]


def _opinion(one: float, two: float) -> int:
    """1 where the first is better by more than 5 %, -1 where the second is, 0 for neither."""
    return (one < 0.95 * two) - (two < 0.95 * one)


def flight_set(
    name: str,
    used_for: str,
    scenarios: Sequence[Path],
    methods: Sequence[str],
    rides: Mapping[Order, Ride],
) -> FlightSet:
    """The figures of a set's flights; one that failed by any method is left out."""
    found: dict[str, dict[str, Figures]] = {}
    for path in scenarios:
        flown = {m: rides[Order(path, (f"cueing.method={m}",))] for m in methods}
        if all(ride["result"] == "ok" for ride in flown.values()):
            still = flown[STILL]["metrics"]
            found[path.stem] = {m: figures(ride["metrics"], still) for m, ride in flown.items()}
    return FlightSet(name, used_for, found)


def by_the_rule(found: FlightSet, methods: Sequence[str]) -> list[str]:
    """Methods that may be the default, the best first.

    The lowest geometric mean of R and R3 together, and on no flight more than 5 % worse than
    `still`. What a tick may cost is for `tools/benchmark` to say.
    """
    summaries = {method: found.summary(method) for method in methods}
    fit = [m for m in methods if summaries[m]["most"] <= MOST_WORSE and m != STILL]
    return sorted(fit, key=lambda m: summaries[m]["together"])


def to_json(sets: Sequence[FlightSet], methods: Sequence[str], default: str) -> dict[str, Any]:
    """Everything, by set."""
    return {
        each.name: {
            "used_for": each.used_for,
            "summary": {method: each.summary(method) for method in methods},
            "default_beside": {
                other: each.beside(default, other) for other in methods if other != default
            },
            "disputed": {
                other: each.disputed(default, other) for other in methods if other != default
            },
            "flights": {
                flight: {method: asdict(f) for method, f in by_method.items()}
                for flight, by_method in each.flights.items()
            },
        }
        for each in sets
    }
