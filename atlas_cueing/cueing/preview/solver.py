"""The convex programme behind both parts of the plan; the only place that knows clarabel.

Clarabel (P. Goulart & Y. Chen, arXiv:2405.12762, 2024) is an interior-point method for sparse
quadratic costs over cones. It is the one of the three tried that takes the rotation's bounds as
they are, lengths of vectors; each solve costs time and memory in proportion to the flight.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.sparse import csc_array, csc_matrix, hstack, kron, triu, vstack

from ...errors import InputError, MissingExtraError
from ...rotations import Array

_SOLVED = ("Solved", "AlmostSolved")  # the latter to 5e-5 of the cost and 1e-4 of the bounds


def clarabel() -> Any:
    """Give the solver's module. Raises MissingExtraError when it is not installed."""
    try:
        import clarabel as module
    except ModuleNotFoundError as error:
        raise MissingExtraError("method 'preview'", "clarabel", "preview") from error
    return module


@dataclass(slots=True)
class Bounds:
    """Rows A x + s = b, block by block, with the cone that each block's s is in."""

    rows: list[csc_array] = field(default_factory=list)
    sides: list[Array] = field(default_factory=list)
    cones: list[Any] = field(default_factory=list)

    def equal(self, matrix: csc_array, side: Array) -> None:
        """Demand matrix x = side."""
        self._add(matrix, side, [clarabel().ZeroConeT(matrix.shape[0])])

    def zero(self, matrix: csc_array) -> None:
        """Demand matrix x = 0."""
        self.equal(matrix, np.zeros(matrix.shape[0]))

    def within(self, matrix: csc_array, bound: float) -> None:
        """Demand |matrix x| <= bound, row by row."""
        scaled, n = matrix / bound, 2 * matrix.shape[0]
        self._add(
            csc_array(vstack([scaled, -scaled])), np.ones(n), [clarabel().NonnegativeConeT(n)]
        )

    def length(self, matrix: csc_array, bound: float) -> None:
        """Bound the length of each vector that the matrix makes of the 3-vectors in x."""
        n = matrix.shape[0]
        rows = kron(matrix / bound, np.vstack([np.zeros(3), -np.eye(3)]))
        self._add(
            csc_array(rows), np.tile([1.0, 0.0, 0.0, 0.0], n), [clarabel().SecondOrderConeT(4)] * n
        )

    def among(self, before: int, total: int) -> "Bounds":
        """Give the same bounds where x is part of a longer vector.

        That has `total` unknowns, and x begins after the first `before` of them.
        """
        padded = []
        for rows in self.rows:
            m, n = rows.shape
            padded.append(
                csc_array(
                    hstack([csc_array((m, before)), rows, csc_array((m, total - before - n))])
                )
            )
        return Bounds(padded, list(self.sides), list(self.cones))

    def __add__(self, other: "Bounds") -> "Bounds":
        return Bounds(self.rows + other.rows, self.sides + other.sides, self.cones + other.cones)

    def _add(self, rows: csc_array, side: Array, cones: list[Any]) -> None:
        self.rows.append(rows)
        self.sides.append(side)
        self.cones.extend(cones)


def minimise(quadratic: csc_array, linear: Array, bounds: Bounds) -> Array:
    """Give the x that makes x.quadratic x / 2 + linear.x least within the bounds.

    Raises InputError when the solver finds none.
    """
    module = clarabel()
    settings = module.DefaultSettings()
    # the same plan to the last bit
    settings.verbose, settings.max_threads, settings.direct_solve_method = False, 1, "qdldl"
    size = float(np.max(np.abs(linear), initial=0.0)) or 1.0
    rows, sides = csc_matrix(vstack(bounds.rows)), np.concatenate(bounds.sides)
    upper = csc_matrix(triu(quadratic / size))
    solution = module.DefaultSolver(
        upper, linear / size, rows, sides, bounds.cones, settings
    ).solve()
    x = np.asarray(solution.x, dtype=np.float64)
    if str(solution.status) not in _SOLVED or not np.all(np.isfinite(x)):
        raise InputError(
            f"method 'preview' found no plan for this flight: clarabel ended {solution.status}"
            f" after {solution.iterations} steps; use another method, or another planning_rate_hz"
        )
    return x
