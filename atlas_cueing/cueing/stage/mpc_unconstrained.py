"""The plan of one stage axis where no limit is met.

The optimum in closed form, linear in the state.

With the unknowns x, the state s = (p, v, a, d) and the one equation rows_e x + offset_e s = 0 (a
standstill at the end), the least x hessian x / 2 + x gradient s has a multiplier y with

    | hessian  rows_e^T | | x |     | gradient |
    | rows_e      0     | | y | = - | offset_e | s

(Boyd & Vandenberghe, Convex Optimization, 2004, section 10.1.1). If this x keeps all limits, it is
the optimum with them, too, and nothing has to be searched for; so it is for nine plans of ten in
ordinary flights.
"""

# mypyc: runs every tick

from collections.abc import Sequence

import numpy as np

from ...rotations import Array

State = tuple[float, float, float, float]


class Plan:
    """The jerk (m/s^3) of each block, linear in a state.

    Worked out when asked for, as few get beyond the first.
    """

    def __init__(self, rows: list[State], state: State) -> None:
        """Block k has the jerk rows[k] . state."""
        self._rows, self._state = rows, state

    def jerk(self, block: int) -> float:
        """Give the jerk (m/s^3) of one block."""
        row, state = self._rows[block], self._state
        return row[0] * state[0] + row[1] * state[1] + row[2] * state[2] + row[3] * state[3]

    @property
    def jerks(self) -> list[float]:
        """The jerks (m/s^3) of all blocks."""
        return [self.jerk(block) for block in range(len(self._rows))]


class UnlimitedPlan:
    """The plan without limits, and whether the limits would have changed it."""

    def __init__(
        self, durations: Sequence[float], cost: Array, bounded: Array, bound: Array
    ) -> None:
        """Solve for blocks of these durations (s).

        cost, bounded and bound are the matrices that `mpc_qp` makes for (p, v, a, d, x).
        """
        m = len(durations) - 1
        equation = bounded[-1]
        system = np.block(
            [[cost[4:, 4:], equation[4:, None]], [equation[None, 4:], np.zeros((1, 1))]]
        )
        x = np.linalg.solve(system, -np.vstack([cost[4:, :4], equation[:4]]))[:m]  # (m, 4)
        # share of each bound, by state
        self._used = (bounded[:-1, :4] + bounded[:-1, 4:] @ x) / bound[:-1, None]
        # of the first block's jerk, which comes behind the m unknowns
        self._first = _state(self._used[m])
        self._worst = _state(np.max(np.abs(np.delete(self._used, m, axis=0)), axis=0))
        # acceleration at the end of each block
        ends = np.vstack([np.array([0.0, 0.0, 1.0, 0.0]), x, np.zeros(4)])
        rows = (np.diff(ends, axis=0) / np.asarray(durations)[:, None]).tolist()
        self._jerk: list[State] = [(p, v, a, d) for p, v, a, d in rows]

    def plan(self, state: State) -> Plan:
        """Give the plan from p, v, a and the demand now."""
        return Plan(self._jerk, state)

    def is_free(self, state: State) -> bool:
        """Whether the plan from this state keeps every limit.

        Nearly all states are settled by the first jerk, which is the nearest to its limit since it
        has to catch up with a demand that jumps, and by a bound on all the others at once.
        """
        first, worst = self._first, self._worst
        if (
            abs(
                first[0] * state[0]
                + first[1] * state[1]
                + first[2] * state[2]
                + first[3] * state[3]
            )
            > 1.0
        ):
            return False
        if (
            worst[0] * abs(state[0])
            + worst[1] * abs(state[1])
            + worst[2] * abs(state[2])
            + worst[3] * abs(state[3])
            <= 1.0
        ):
            return True
        return bool(np.max(np.abs(self._used @ np.array(state))) <= 1.0)


def _state(values: Array) -> State:
    p, v, a, d = values.tolist()
    return (p, v, a, d)
