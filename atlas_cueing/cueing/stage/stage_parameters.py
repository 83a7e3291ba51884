"""What a user can choose about the stage."""

from dataclasses import dataclass
from math import inf
from typing import Literal, TypeAlias

from ...rotation import Vec3
from ..parameter import ONES, Choice, Parameter, Range

Planner: TypeAlias = Literal["horizon", "onset"]


@dataclass(frozen=True, slots=True)
class MpcParameters:
    """How the stage plans ahead (`mpc`); what STAGE does not have is fixed.

    planning_rate: plans per second, at least, Hz.
    length: from now to where every plan stands, s.
    blocks: pieces of constant jerk in a plan, short ones first (9 to 16 made no difference).
    fade: time constant with which the demand is thought to go on, s (assumed); it counts only where
        a limit is in the way.
    excess: the demand is limited smoothly at this many times what the high-pass could follow for
        any demand (found).
    memory: time over which the useful share of the demand is measured, s.
    first_share: that share at the start.
    doubt: mean square acceleration of the filter, m^2/s^4, at which experience counts as much as
        the first share (assumed).
    """

    planning_rate: float = 50.0
    length: float = 5.0
    blocks: int = 12
    fade: float = 5.0
    excess: float = 4.0
    memory: float = 15.0
    first_share: float = 0.2
    doubt: float = 0.01


@dataclass(frozen=True, slots=True)
class StageParameters:
    """The stage: onsets of the acceleration that the rider's head should have, inside the travel.

    Vectors are per axis x, y, z of W. FORCE_GAIN and STAGE say what each is, with its source.
    """

    force_gain: Vec3 = ONES
    onset: Vec3 = (0.7, 0.7, 0.7)
    recentre: Vec3 = (0.2, 0.2, 0.2)
    bandwidth: float = 5.0
    travel: Vec3 = (inf, inf, inf)
    planner: Planner = "horizon"
    mpc: MpcParameters = MpcParameters()


GAIN = Range(0.0, 10.0)

FORCE_GAIN = Parameter(
    "force_gain",
    "force_gain",
    GAIN,
    "factor on the acceleration demanded of the stage's x, y, z",
    "one to one (with planner onset, 0.4 and onset_rad_s 2 did best)",
)
"""It stands beside the method's own gain, and not in the table of the stage."""

STAGE = (
    Parameter(
        "planner",
        "planner",
        Choice(("horizon", "onset")),
        "horizon plans ahead to a standstill; onset is the high-pass by itself, which has to be"
        " slower to move or quicker to brake",
        "found: the least force error",
    ),
    Parameter(
        "onset_rad_s",
        "onset",
        Range(0.01, 50.0),
        "natural frequency of the braking high-pass: lower is slower to brake and needs more"
        " travel",
        "found; TU Delft's classical set has 0.8 to 1",
    ),
    Parameter(
        "recentre_rad_s",
        "recentre",
        Range(0.0, 10.0),
        "corner of the return to the centre, which takes at most travel recentre^2 of"
        " acceleration; 0 for none beyond the high-pass",
        "0.04 m/s^2 at 1 m, below the 0.063 (horizontal) and 0.154 m/s^2 (vertical) at which"
        " linear motion begins to be felt (Benson, Spencer & Stott, Aviation, Space and"
        " Environmental Medicine 57, 1986)",
    ),
    Parameter(
        "bandwidth_hz",
        "bandwidth",
        Range(1e-3, 100.0),
        "corner of the low-pass on the demand",
        "assumed",
    ),
    Parameter(
        "travel_m",
        "travel",
        Range(1e-6, 1e3),
        "no more than this of the platform's travel is used",
        "the platform's own travel counts where it is left out",
    ),
    Parameter(
        "planning_rate_hz",
        "mpc.planning_rate",
        Range(10.0, 1000.0),
        "plans per second, at least",
        "assumed; 25 to 100 Hz made no difference of 0.3 % to the force error",
    ),
    Parameter(
        "horizon_s",
        "mpc.length",
        Range(1.0, 20.0),
        "from now to where every plan stands",
        "assumed: braking is over by then, 3.5 / onset; 4 to 7 s made no difference",
    ),
    Parameter(
        "memory_s",
        "mpc.memory",
        Range(1.0, 1000.0),
        "time over which the share of the demand that is worth moving for is measured",
        "assumed; 8 to 30 s do",
    ),
    Parameter(
        "first_share",
        "mpc.first_share",
        Range(0.0, 1.0),
        "that share at the start",
        "found: more would cost where little is to be won",
    ),
)
"""The keys of `[cueing.stage]`."""
