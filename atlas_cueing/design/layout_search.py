"""The search for layouts: each of many mixtures of the objectives, by differential evolution.

The layouts of which none is better in every objective are found one by one: for weights w, the
layout at which

    max_j w_j c_j + 0.001 sum_j w_j c_j,   c_j = (cost_j - low_j) / (high_j - low_j)

is least (augmented Chebyshev scalarisation: Steuer & Choo, Math. Programming 26, 1983), which
reaches every such layout, also where the front is not convex. low and high: over an even sample of
the ranges (Sobol). Each is a problem of its own with a seed of its own, so the answers do not
depend on who solves which, or when (Storn & Price, J. Global Optimization 11, 1997).

Within the search a layout meets only the worst ticks: those at which some layout of a sample, or
one that was found before, had a figure at its largest. A largest value over some of the ticks is
never more than over all, so no layout is thought worse than it is; what is found is measured at
every tick, and where it turns out worse, those ticks are added and the search goes on from there.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array
from ..scenario import Platform
from .layout import Layout
from .measure import Measured, measure
from .objective import costs
from .ridden import Ridden

Ticks = NDArray[np.intp]
SAMPLE = 256  # layouts that give the scale of each objective
TICK_SAMPLE = 64  # layouts whose worst ticks are the first ones
_GENERATIONS = 22
_POPULATION = 8  # for each number that is searched
_REFINED = 50  # evaluations of the last part, for each number that is searched
_SETTLED = 1e-6  # spread of the population, of its mean
_FINE = 1e-5  # of a number and of the mixture: the last part is good to that
_IMPOSSIBLE = 1e6
_SUM = 1e-3  # weight of the sum beside the largest


@dataclass(frozen=True)
class Problem:
    """What is searched: `ranges` (low, high) by the words of a layout, all else as in `start`.

    low, high: costs that become 0 and 1, of each objective. ridden: the worst ticks.
    """

    platform: Platform
    start: Layout
    ranges: Mapping[str, tuple[float, float]]
    objectives: tuple[str, ...]
    ridden: Ridden
    low: tuple[float, ...] = ()
    high: tuple[float, ...] = ()

    def layout(self, x: Sequence[float]) -> Layout:
        """The layout of a point of the ranges."""
        return self.start.with_values(dict(zip(self.ranges, map(float, x), strict=True)))

    def scalar(self, layout: Layout, weights: Sequence[float]) -> float:
        """The mixture of the objectives at a layout; large where it cannot be built."""
        found = measure(self.platform, layout, self.ridden)
        if found is None:
            return _IMPOSSIBLE
        low, high = np.array(self.low), np.array(self.high)
        share = (costs(found.figures, self.objectives) - low) / np.where(
            high > low, high - low, 1.0
        )
        weighed = np.array(weights) * share
        return float(weighed.max() + _SUM * weighed.sum())


def sample(problem: Problem, count: int, seed: int) -> list[Layout]:
    """Return `count` layouts, a power of two, evenly spread over the ranges."""
    from scipy.stats import qmc

    points = qmc.Sobol(len(problem.ranges), scramble=True, seed=seed).random(count)
    low, high = np.array(list(problem.ranges.values())).T
    return [problem.layout(point) for point in low + points * (high - low)]


@dataclass(frozen=True, slots=True)
class Mixture:
    """One search: weights of the objectives, its seed, and the point that it begins at, if any."""

    weights: tuple[float, ...]
    seed: int
    begin: tuple[float, ...] = ()


def solve(problem: Problem, mixture: Mixture) -> list[float] | None:
    """Find the point of the ranges that is best by a mixture; None where nothing can be built.

    By differential evolution, unless the mixture has a point to begin at; and from there by the
    simplex method (Nelder & Mead, Computer Journal 7(4), 1965), as the mixture has kinks.
    """
    from scipy.optimize import minimize

    bounds: Any = list(problem.ranges.values())

    def scalar(x: Any, /) -> float:
        """The mixture at a point of the ranges."""
        return problem.scalar(problem.layout(x), mixture.weights)

    begin = mixture.begin or _evolved(scalar, bounds, mixture.seed)
    options: Any = {"maxfev": _REFINED * len(bounds), "xatol": _FINE, "fatol": _FINE * _FINE}
    refined = minimize(scalar, begin, method="Nelder-Mead", bounds=bounds, options=options)
    best = refined.x.tolist() if refined.fun < scalar(begin) else list(begin)
    return [float(x) for x in best] if scalar(best) < _IMPOSSIBLE else None


def _evolved(scalar: Any, bounds: Any, seed: int) -> tuple[float, ...]:
    from scipy.optimize import differential_evolution

    found = differential_evolution(
        scalar,
        bounds,
        popsize=_POPULATION,
        maxiter=_GENERATIONS,
        tol=_SETTLED,
        init="sobol",
        polish=False,
        seed=seed,
    )
    return tuple(map(float, found.x))


def mixtures(objectives: int, count: int, seed: int) -> list[Mixture]:
    """Weights, and a seed for each: all equal, each objective almost alone, then random ones."""
    if objectives == 1:
        return [Mixture((1.0,), seed)]
    rng = np.random.default_rng(seed)
    alone = [np.where(np.arange(objectives) == k, 1.0, 0.02) for k in range(objectives)]
    random = rng.dirichlet(np.ones(objectives), max(count - objectives - 1, 0))
    rows = [np.ones(objectives), *alone, *random][:count]
    return [Mixture(tuple((row / row.sum()).tolist()), seed + k) for k, row in enumerate(rows)]


def first_ticks(problem: Problem, everything: Ridden, layouts: Sequence[Layout]) -> Ticks:
    """The ticks at which layouts of a sample are at their worst, on their wheels alone."""
    platform = problem.platform.model_copy(update={"support": None})
    worst = [
        found for layout in layouts if (found := measure(platform, layout, everything)) is not None
    ]
    return added(np.zeros(1, np.intp), worst)


def scaled(problem: Problem, layouts: Sequence[Layout]) -> tuple[Array, list[Measured]]:
    """Least and largest costs (2, objectives) of layouts at the worst ticks, and figures."""
    found = [
        each for layout in layouts if (each := measure(problem.platform, layout, problem.ridden))
    ]
    if not found:
        none = np.zeros((2, len(problem.objectives)))
        return none, []
    table = np.array([costs(each.figures, problem.objectives) for each in found])
    return np.array([table.min(axis=0), table.max(axis=0)]), found


def added(ticks: Ticks, found: Sequence[Measured]) -> Ticks:
    """Ticks with those at which the layouts found are at their worst."""
    return np.unique(np.concatenate([ticks, *(each.worst for each in found)]))
