"""The plan of one stage axis where no limit is met: the optimum in closed form, linear in the state.

With the unknowns x, the state s = (p, v, a, d) and the one equation rows_e x + offset_e s = 0 (a standstill at the end), the
least x hessian x / 2 + x gradient s has a multiplier y with

    | hessian  rows_e^T | | x |     | gradient |
    | rows_e      0     | | y | = - | offset_e | s

(Boyd & Vandenberghe, Convex Optimization, 2004, section 10.1.1). If this x keeps all limits, it is the optimum with them, too,
and nothing has to be searched for; so it is for nine plans of ten in ordinary flights.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
State = tuple[float, float, float, float]


class UnlimitedPlan:
    """Jerks without limits, and whether the limits would have changed them."""

    def __init__(self, durations: Sequence[float], cost: Array, bounded: Array, bound: Array) -> None:
        """Blocks of these durations (s); cost, bounded and bound as `horizon_problem` makes them for (p, v, a, d, x)."""
        m = len(durations) - 1
        equation = bounded[-1]
        system = np.block([[cost[4:, 4:], equation[4:, None]], [equation[None, 4:], np.zeros((1, 1))]])
        x = np.linalg.solve(system, -np.vstack([cost[4:, :4], equation[:4]]))[:m]  # (m, 4)
        self._used = (bounded[:-1, :4] + bounded[:-1, 4:] @ x) / bound[:-1, None]  # share of each bound, by state
        worst: list[float] = np.max(np.abs(self._used), axis=0).tolist()
        self._worst = (worst[0], worst[1], worst[2], worst[3])
        ends = np.vstack([np.array([0.0, 0.0, 1.0, 0.0]), x, np.zeros(4)])  # acceleration at the end of each block
        rows = (np.diff(ends, axis=0) / np.asarray(durations)[:, None]).tolist()
        self._jerk: list[State] = [(p, v, a, d) for p, v, a, d in rows]

    def jerks(self, state: State) -> list[float]:
        """Jerk (m/s^3) of each block from p, v, a and the demand now."""
        p, v, a, d = state
        return [row[0] * p + row[1] * v + row[2] * a + row[3] * d for row in self._jerk]

    def is_free(self, state: State) -> bool:
        """Whether it keeps every limit; most states are settled by a bound on all of them at once."""
        worst = self._worst
        if worst[0] * abs(state[0]) + worst[1] * abs(state[1]) + worst[2] * abs(state[2]) + worst[3] * abs(state[3]) <= 1.0:
            return True
        return bool(np.max(np.abs(self._used @ np.array(state))) <= 1.0)
