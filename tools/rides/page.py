"""The results as Markdown."""

from collections.abc import Iterable, Mapping, Sequence

from atlas_cueing.evaluation import mismatch_ratio

from .figures import NAMES
from .results import FlightSet, by_the_rule

HEADS = {
    "direction": "direction, deg",
    "force": "force, m/s²",
    "rate": "felt rate, deg/s",
    "M": "M",
    "R": "R",
    "R3": "R3",
    "worst": "worst 10 s of M",
    "tilt": "observer: tilt, deg",
    "turn": "observer: turn, deg/s",
}
_DIGITS = {"R": 3, "R3": 3, "force": 2, "together": 3}
INTRODUCTION = """\
# Results

Made by `tools/results --write`: every flight by every method with its defaults, on `atlas-2.9m`,
with the stage, smoothing and wheels behind each. Nobody has ridden any of it: these are figures of
models. Rider less pilot, rms:

- **direction** of the specific force, specific **force**, and **felt rate**, the angular rate
  behind the semicircular canals;
- **M**, the mismatch in just noticeable differences, `M² = mean |Δf|²/(0.17 m/s²)² + mean |C
  Δw|²/(3 deg/s)²`: 1 is an error that is just noticed, all the way;
- **R**, M beside a cabin that stands still, `max(M, 1)/max(M_still, 1)`: 1 is as bad as not turning
  at all;
- **R3**, the same with the rate's leg of M three times as large: `M3² = M_magnitude² +
  M_direction² + (3 M_rate)²`, for those who mind false rates more;
- **worst 10 s**, the largest M of any ten seconds;
- **observer**, a second opinion of another kind: the difference of perceived tilt and turn by a
  model of perception (Rader, Oman & Merfeld 2009).

Means over flights are arithmetic, those of ratios geometric. What each figure is exactly stands in
`atlas_cueing/evaluation`.
"""


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table of Markdown, numbers to the right of the first column."""
    lines = [heads, ["---", *["---:"] * (len(heads) - 1)], *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def number(name: str, value: float) -> str:
    """A figure with its digits."""
    return f"{value:.{_DIGITS.get(name, 1)}f}"


def count(flights: int) -> str:
    """So many flights, in words."""
    return f"{flights} flight{'' if flights == 1 else 's'}"


def section(found: FlightSet, methods: Sequence[str], default: str) -> str:
    """A set: means by method, the default beside the others, flights, and every figure."""
    parts = [
        f"## {found.name.capitalize()}: {count(len(found.flights))}, {found.used_for}",
        _means(found, methods),
        f"By the rule, best first: {', '.join(by_the_rule(found, methods)) or 'none'}.",
        f"`{default}` beside the others (below 1 it is better; 90 % by bootstrap over flights; won"
        " and lost by more than 1 %):",
        _beside(found, [method for method in methods if method != default], default),
        _disputes(found, [method for method in methods if method != default], default),
        "R by flight, the best bold:",
        _flights(found, methods),
        "<details><summary>Every figure of every flight</summary>\n",
        _every(found, methods),
        "</details>",
    ]
    return "\n\n".join(parts) + "\n"


def _means(found: FlightSet, methods: Sequence[str]) -> str:
    summaries = {method: found.summary(method) for method in methods}
    rows = [[HEADS[name], *(number(name, summaries[m][name]) for m in methods)] for name in NAMES]
    rows += [
        ["R and R3 together", *(number("together", summaries[m]["together"]) for m in methods)]
    ]
    rows += [
        ["worse than still (largest R)"]
        + [f"{summaries[m]['worse_than_still']} ({summaries[m]['most']:.3f})" for m in methods]
    ]
    return table(["mean", *methods], rows)


def _beside(found: FlightSet, others: Sequence[str], default: str) -> str:
    rows = []
    for other in others:
        beside = found.beside(default, other)
        cells = [f"{b['ratio']:.3f} ({b['low']:.3f} to {b['high']:.3f})" for b in beside.values()]
        rows.append([other, *cells, f"{beside['R']['wins']} and {beside['R']['losses']}"])
    return table([f"{default} over", "R", "R3", "flights won and lost by R"], rows)


def _disputes(found: FlightSet, others: Sequence[str], default: str) -> str:
    names = {other: found.disputed(default, other) for other in others}
    told = [f"{other} on {', '.join(flights)}" for other, flights in names.items() if flights]
    return (
        f"M and the observer disagree (each by more than 5 %) about `{default}` against"
        f" {'; '.join(told)}. There only riders can decide."
        if told
        else f"M and the observer nowhere disagree about `{default}` against any other."
    )


def _flights(found: FlightSet, methods: Sequence[str]) -> str:
    rows = []
    for flight, by_method in found.flights.items():
        least = min(by_method[m].R for m in methods)
        cells = [number("R", by_method[m].R) for m in methods]
        rows.append([flight, *(f"**{c}**" if c == number("R", least) else c for c in cells)])
    return table(["flight", *methods], rows)


def _every(found: FlightSet, methods: Sequence[str]) -> str:
    rows = [
        [flight, method, *(number(name, getattr(by_method[method], name)) for name in NAMES)]
        for flight, by_method in found.flights.items()
        for method in methods
    ]
    return table(["flight", "method", *(HEADS[name] for name in NAMES)], rows)


def gaps(found: Mapping[str, tuple[float, float]], default: str) -> str:
    """The default beside `preview`, which knows the flight: M of both, and their ratio."""
    rows = [
        [name, f"{m:.2f}", f"{p:.2f}", f"{mismatch_ratio(m, p):.3f}"]
        for name, (m, p) in found.items()
    ]
    return (
        "\n\n".join(
            [
                "## Against knowing the future",
                f"M of `{default}` and of `preview`, which plans the whole flight at once and may"
                " turn the cabin as fast as the wheels do, so that no bound on its turn is itself"
                " the loss. Its plan is by physical rates: on a flight where the canals lose a"
                " lasting turn it may be beaten.",
                table(["flight", default, "preview", "ratio"], rows),
            ]
        )
        + "\n"
    )


RIDERS = """\
## What riders would have to be asked

Nobody has ridden any of this, and the figures leave `hedge` and `force` close together. Pilots of
the aircraft, each in both rides of one flight, in a random order and not told which, eyes closed
and with pictures:

1. Which of the two was nearer to the aircraft, and by how much (0 to 10)?
2. When you rolled into a turn: was the roll there, too small, or of the wrong kind?
3. Was there a turn or a tilt that the aircraft would not have made? Point at it in the replay.
4. Where was the worst moment, and was it the push in the seat or the turning that was wrong?
5. How do you feel (0 to 20, misery), before, after each ride, and half an hour later?
"""
