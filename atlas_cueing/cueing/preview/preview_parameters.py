"""What a user can choose about `preview`, and its declaration."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import e, radians

from ...rotation import Vec3
from ...signals import StageLimits, VehicleState
from ..method import CueSource, Method
from ..parameter import Parameter, Range


@dataclass(frozen=True, slots=True)
class PreviewParameters:
    """What the plan for a whole flight minimises, and how far it may turn beyond the vehicle.

    METHOD says what each is. Errors of force_unit (specific force, m/s^2) and of rate_unit (angular
    rate, rad/s) weigh the same.

    rounds: how often rotation and stage are planned both at once, after one for the other; fixed.
        Of the bundled flights one gains more than 1 % by the second round, and none by the third.
    """

    rate: float = radians(3.0)
    smoothing: float = 0.25
    force_unit: float = 0.17
    rate_unit: float = radians(3.0)
    planning_rate: float = 20.0
    rounds: int = 2

    @property
    def acceleration(self) -> float:
        """The largest acceleration of the turn beyond the vehicle's own, rad/s^2."""
        return 2.0 * self.rate / (e * self.smoothing)

    def plan(
        self, states: Sequence[VehicleState], limits: StageLimits, head_S: Vec3, dt: float
    ) -> CueSource:
        """Plan all cues of a flight; see PlanParameters.

        Raises InputError when there is no plan, and MissingExtraError without the solver.
        """
        from .motion_plan import plan_motion  # loads scipy.sparse, which takes 0.25 s

        return plan_motion(states, self, limits, head_S, dt)


_NOTICED = "what a pilot begins to notice %s (Reid & Nahon, UTIAS Report 296, 1985)"

METHOD = Method(
    "preview",
    "the whole flight is known, so rotation and stage are planned at once",
    PreviewParameters(),
    (
        Parameter(
            "align_rate_deg_s",
            "rate",
            Range(0.0, 720.0, above=True),
            "largest rate of the turn beyond the vehicle's own",
            "as the slow turn of blend",
        ),
        Parameter(
            "align_smoothing_s",
            "smoothing",
            Range(0.01, 1000.0),
            "bounds the acceleration of that turn to 2 rate / (e smoothing)",
            "as the slow turn of blend",
        ),
        Parameter(
            "force_unit_m_s2",
            "force_unit",
            Range(0.01, 100.0),
            "error of specific force that weighs as much as rate_unit_deg_s",
            _NOTICED % "sideways",
        ),
        Parameter(
            "rate_unit_deg_s",
            "rate_unit",
            Range(0.0, 90.0, above=True),
            "error of angular rate that weighs as much as force_unit_m_s2",
            _NOTICED % "in roll",
        ),
        Parameter(
            "planning_rate_hz",
            "planning_rate",
            Range(1.0, 100.0),
            "knots of the plan",
            "assumed: far above the frequencies of what it may do",
        ),
    ),
    fixed=("rounds",),
)
