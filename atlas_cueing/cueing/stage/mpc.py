"""The stage by model predictive control: plans to a standstill, made anew fifty times a second.

The demand is limited and freed of its lasting part by a high-pass, whose motion is only imagined:
it need not stay inside the travel, and shows what share of the demand is worth moving for
(`adaptive_gain`). A plan for that share follows the same filter where the limits allow and does the
next best where they do not (`mpc_qp`). It is flown until the next one; when there is none,
to its end, where the stage stands.
"""

# mypyc: runs every tick

from itertools import pairwise

from .adaptive_gain import AdaptiveGain
from .high_pass import HighPass, demand_bound
from .mpc_qp import AxisLimits, MpcProblem
from .mpc_unconstrained import Plan
from .stage_parameters import MpcParameters


class MpcAxis:
    """One axis of the stage: demand (m/s^2) in, position, velocity and acceleration out."""

    def __init__(
        self,
        dt: float,
        onset: float,
        recentre: float,
        bandwidth: float,
        limits: AxisLimits,
        parameters: MpcParameters,
        delay: int,
    ) -> None:
        """Start at rest in the centre; parameters as in StageParameters, for one axis; dt in s.

        The first plan is made `delay` ticks late, so that three axes need not plan in the same
        tick.
        """
        self._dt = dt
        self._period = planning_ticks(dt, parameters.planning_rate)
        self._ticks = block_ticks(self._period, parameters.length / dt, parameters.blocks)
        bound = parameters.excess * demand_bound(onset, *limits[:3])
        self._imagined = HighPass(dt, onset, recentre, bandwidth, bound)
        self._gain = AdaptiveGain(dt, parameters.memory, parameters.first_share, parameters.doubt)
        self.problem = MpcProblem(
            [ticks * dt for ticks in self._ticks], onset, parameters.fade, limits
        )
        self._to_next = delay % self._period
        self._p = self._v = self._a = 0.0
        self._flown: Plan | None = None  # what is flown; none while the stage stands
        self._block = self._left = 0  # where on it: the block, and its ticks still ahead
        self._jerk = 0.0  # of this block

    def step(self, demand: float) -> tuple[float, float, float]:
        """Give position (m), velocity and acceleration after one tick, for a demand in m/s^2.

        A demand that is there at the start counts as lasting.
        """
        share = self._gain.share
        self._gain.update(demand, self._imagined.step(demand)[2])
        if not self._to_next:
            self._plan(share * self._imagined.high_frequency)
            self._to_next = self._period
        self._to_next -= 1
        self._fly()
        return self._p, self._v, self._a

    def _plan(self, demand: float) -> None:
        """Begin a new plan where the stage was a tick ago; without one the old plan goes on."""
        plan = self.problem.solve(self._p, self._v, self._a, demand)
        if plan is not None:
            self._begin(plan, 0)

    def _begin(self, plan: Plan, block: int) -> None:
        """The next tick is the first one of a block of the plan."""
        self._flown, self._block = plan, block
        self._left, self._jerk = self._ticks[block], plan.jerk(block)

    def _fly(self) -> None:
        """One tick along the plan."""
        plan = self._flown
        if plan is None:
            return
        jerk, dt = self._jerk, self._dt
        self._p += dt * (self._v + dt * (self._a / 2.0 + dt * jerk / 6.0))
        self._v += dt * (self._a + dt * jerk / 2.0)
        self._a += dt * jerk
        self._left -= 1
        if self._left:
            return
        if self._block + 1 < len(self._ticks):
            self._begin(plan, self._block + 1)
        else:
            self._flown, self._v, self._a = None, 0.0, 0.0  # but for rounding they are at rest


def planning_ticks(dt: float, rate: float) -> int:
    """Give the whole ticks of dt (s) from one plan to the next.

    Plans come at no less than `rate` (Hz) where the ticks allow it.
    """
    return max(1, int(1.0 / (rate * dt) + 1e-9))


def block_ticks(period: int, horizon: float, blocks: int) -> list[int]:
    """Give the ticks of each block: whole planning periods, about `horizon` ticks together.

    The first block is one period, and they grow. Since blocks begin and end where plans do, a plan
    always begins within one block of the plan before.
    """
    growth, ends = (1.0 + horizon / period) ** (1.0 / blocks), [0]
    for k in range(1, blocks + 1):
        ends.append(max(ends[-1] + 1, round(growth**k - 1.0)))
    return [period * (end - begin) for begin, end in pairwise(ends)]
