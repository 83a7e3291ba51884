"""The layouts worth having: searched, measured at every tick, and the best of them chosen."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..errors import InputError
from ..scenario import Platform
from .layout import Layout
from .layout_search import (
    SAMPLE,
    TICK_SAMPLE,
    Mixture,
    Problem,
    added,
    first_ticks,
    mixtures,
    sample,
    scaled,
    solve,
)
from .measure import Figures, Measured, measure, measure_fully
from .objective import costs, nearest_to_ideal, not_dominated
from .ridden import Ridden
from .spread import Crew, Kept, stamp_of

ROUNDS = 4  # of search and check; mostly two are enough
_WORSE = 5e-3  # of a figure: by so much it may be worse at all ticks than at the worst ones
_PEAKS = (
    "preload_needed_n",
    "wheel_load_max_n",
    "torque_max_n_m",
    "wheel_speed_max_rad_s",
    "power_peak_w",
    "regenerated_peak_w",
)
Tell = Callable[[str, float], None]


@dataclass(frozen=True, slots=True)
class Rated:
    """A layout with its figures at every tick.

    source: "platform" as it was given, "asked" for by the user, or "found". on_front: whether none
    of the others is better in one objective and as good in all.
    """

    layout: Layout
    figures: Figures
    source: str
    on_front: bool

    def to_json(self) -> dict[str, Any]:
        """The layout and its figures by name, the unit in the name."""
        layout = {
            "elevation_deg": self.layout.elevation,
            "skew_deg": self.layout.skew,
            "azimuth_deg": self.layout.azimuth,
            "wheel_radius_m": self.layout.radius,
            "gear": self.layout.gear,
        }
        return {"source": self.source, "on_front": self.on_front, **layout, **self.figures}


@dataclass(frozen=True, slots=True)
class Front:
    """What came of a design.

    rated: all layouts; first the platform's own and those asked for, then those found, least
    preload first. chosen: number of the one that is nearest to the ideal. worst_ticks: of `ticks`,
    those that the search met. gap: by which a figure was at most worse at all ticks than at those,
    relative.
    """

    rated: tuple[Rated, ...]
    chosen: int
    objectives: tuple[str, ...]
    ticks: int
    worst_ticks: int
    gap: float
    rounds: int


def design_stamp(problem: Problem, asked: Sequence[Layout], searches: int, seed: int) -> str:
    """A stamp of all that a table of layouts depends on: the same stamp, the same table."""
    return stamp_of(
        _content(problem.platform),
        *_bytes(problem.ridden),
        problem.start,
        sorted(problem.ranges.items()),
        problem.objectives,
        tuple(asked),
        searches,
        seed,
    )


def search_front(
    problem: Problem,
    everything: Ridden,
    asked: Sequence[Layout],
    *,
    searches: int,
    seed: int,
    crew: Crew,
    kept: Kept,
    tell: Tell,
) -> Front:
    """Search the layouts of the ranges, check what is found at every tick, and choose.

    problem: without ticks and scale. asked: layouts to be measured beside. searches: mixtures of
    the objectives. tell: called with what is done and its share. Raises InputError where no layout
    of the ranges can be built.
    """
    whole = stamp_of(_content(problem.platform), *_bytes(everything))
    given = [problem.start, *asked]
    spread_out = sample(problem, SAMPLE, seed)
    tell("worst ticks", 0.0)
    ticks = first_ticks(problem, everything, [*given, *spread_out[:TICK_SAMPLE]])
    checked: dict[Layout, Measured | None] = {}
    gap, tasks = 0.0, mixtures(len(problem.objectives), searches, seed)
    for turn in range(1, ROUNDS + 1):
        problem = _with_ticks(problem, everything.at(ticks), spread_out)
        points = _searched(problem, tasks, crew, kept, _part(tell, f"search {turn}"))
        found = [problem.layout(point) for point in points if point]
        new = [layout for layout in dict.fromkeys([*given, *found]) if layout not in checked]
        measured = _measured(
            problem.platform, new, everything, whole, crew, kept, _part(tell, f"check {turn}")
        )
        checked |= dict(zip(new, measured, strict=True))
        here = [each for layout in found if (each := checked[layout])]
        gap = _gap(problem, here)
        more = added(ticks, here)
        if gap <= _WORSE or len(more) == len(ticks):
            break
        ticks = more if turn < ROUNDS else ticks
        tasks = [
            replace(task, begin=tuple(point or ()))
            for task, point in zip(tasks, points, strict=True)
        ]
    last = {layout: checked[layout] for layout in dict.fromkeys([*given, *found])}
    rated, chosen = _rated(problem, given, last)
    return Front(rated, chosen, problem.objectives, len(everything), len(ticks), gap, turn)


def _with_ticks(problem: Problem, ridden: Ridden, layouts: Sequence[Layout]) -> Problem:
    (low, high), found = scaled(replace(problem, ridden=ridden), layouts)
    if not found:
        raise InputError(
            "--range: no layout in these ranges can be built: drives that turn the sphere about"
            " every axis, and wheels that do not meet; widen them"
        )
    return replace(problem, ridden=ridden, low=tuple(low.tolist()), high=tuple(high.tolist()))


def _searched(
    problem: Problem, tasks: Sequence[Mixture], crew: Crew, kept: Kept, done: Callable[[int], Any]
) -> list[list[float] | None]:
    """The points found, one for each task."""
    stamp = stamp_of(
        _content(problem.platform),
        problem.start,
        sorted(problem.ranges.items()),
        problem.objectives,
        problem.low,
        problem.high,
        *_bytes(problem.ridden),
    )
    return kept.each(crew, solve, problem, tasks, stamp, done(len(tasks)))


def _measured(
    platform: Platform,
    layouts: Sequence[Layout],
    everything: Ridden,
    whole: str,
    crew: Crew,
    kept: Kept,
    done: Callable[[int], Any],
) -> list[Measured | None]:
    rows = kept.each(
        crew, measured_row, (platform, everything), layouts, whole, done(len(layouts)), heavy=True
    )
    return [
        row and Measured(layout, row["figures"], np.array(row["worst"], np.intp))
        for layout, row in zip(layouts, rows, strict=True)
    ]


def measured_row(shared: tuple[Platform, Ridden], layout: Layout) -> dict[str, Any] | None:
    """Figures and worst ticks of a layout at every tick, as JSON takes them."""
    found = measure_fully(shared[0], layout, shared[1])
    return {"figures": found.figures, "worst": found.worst.tolist()} if found else None


def _gap(problem: Problem, found: Sequence[Measured]) -> float:
    """By how much a figure is worse at all ticks than at the worst ones, of its size."""
    gaps = [0.0]
    for each in found:
        thought = measure(problem.platform, each.layout, problem.ridden)
        if not thought:
            continue
        for name in _PEAKS:
            real, seen = each.figures[name], thought.figures[name]
            gaps.append((real - seen) / max(abs(real), 1e-9))
    return max(gaps)


def _rated(
    problem: Problem, given: Sequence[Layout], checked: Mapping[Layout, Measured | None]
) -> tuple[tuple[Rated, ...], int]:
    sources = dict.fromkeys(checked, "found") | dict.fromkeys(given, "asked")
    sources[problem.start] = "platform"
    built = [each for each in checked.values() if each is not None]
    table = np.array([costs(each.figures, problem.objectives) for each in built])
    front = set(not_dominated(table))
    rows = [
        Rated(each.layout, each.figures, sources[each.layout], k in front)
        for k, each in enumerate(built)
        if k in front or sources[each.layout] != "found"
    ]
    order = {"platform": 0, "asked": 1, "found": 2}
    rows.sort(key=lambda row: (order[row.source], row.figures["preload_needed_n"]))
    able = [k for k, row in enumerate(rows) if row.on_front]
    best = np.array([costs(rows[k].figures, problem.objectives) for k in able])
    return tuple(rows), able[nearest_to_ideal(best)]


def _content(platform: Platform) -> bytes:
    return platform.model_dump_json().encode()


def _bytes(ridden: Ridden) -> list[bytes]:
    return [np.ascontiguousarray(getattr(ridden, name)).tobytes() for name in ridden.__slots__]


def _part(tell: Tell, name: str) -> Callable[[int], Callable[[], None]]:
    """A function that counts the pieces of a part of the work, and tells their share."""

    def of(count: int) -> Callable[[], None]:
        """Begin a part of `count` pieces; what is returned counts one of them."""
        done = 0

        def one() -> None:
            """Count one piece, and tell."""
            nonlocal done
            done += 1
            tell(f"{name}: {done} of {count}", done / count)

        tell(f"{name}: 0 of {count}", 0.0)
        return one

    return of
