"""What a user can choose about cueing; defaults carry their source."""

from dataclasses import dataclass
from math import e, inf, pi, radians
from typing import TypeAlias

from ..rotation import Vec3

ONES: Vec3 = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class SlowTurnParameters:
    """The turn of the cabin that the vehicle does not make.

    rate: largest rate, rad/s. 3 deg/s is the customary limit (Groen & Bles, J. Vestibular Research
        14, 2004).
    time: an error is taken back in about this time while the rate allows, s (assumed).
    smoothing: time constant of the critically damped filter on the rate, s (assumed). It bounds the
        acceleration of the turn to 2 rate / (e smoothing), reached when the rate flips from one
        limit to the other.
    """

    rate: float = radians(3.0)
    time: float = 2.0
    smoothing: float = 0.25


@dataclass(frozen=True, slots=True)
class AttitudeParameters:
    """Method `attitude`: the sphere takes the vehicle's attitude, for ever.

    rotation_gain: factor on the vehicle's turn about the cabin's x, y, z.
    turn: takes back what the body rates leave to the attitude, above all after a jump.
    """

    rotation_gain: Vec3 = ONES
    turn: SlowTurnParameters = SlowTurnParameters()


@dataclass(frozen=True, slots=True)
class BlendParameters:
    """Method `blend`: body rates one to one, plus the slow turn towards the vehicle's specific force.

    rotation_gain: factor on the vehicle's rates about the cabin's x, y, z.
    bandwidth: natural frequency of the filter on the force whose turning the slow turn goes along
        with, rad/s (assumed).
    hold: the slow turn fades out where the specific force falls from twice this magnitude to it,
        m/s^2 (assumed).
    """

    rotation_gain: Vec3 = ONES
    bandwidth: float = 2.0 * pi
    hold: float = 1.5
    turn: SlowTurnParameters = SlowTurnParameters()


@dataclass(frozen=True, slots=True)
class ForceParameters:
    """Method `force`: W's up follows the vehicle's specific force in the cabin.

    rotation_gain: factor on the vehicle's rates; only what of them lies along the force is used.
    bandwidth: natural frequency of the filter on the force, rad/s (assumed: 1 Hz, above manoeuvres
        and below buffeting).
    hold: the cabin follows the force fully from twice this magnitude on and not at all below it,
        m/s^2 (assumed).
    turn: takes back what misalignment is left (assumed: half a turn a second at most, as fast as
        the wheels of Atlas).
    """

    rotation_gain: Vec3 = ONES
    bandwidth: float = 2.0 * pi
    hold: float = 1.5
    turn: SlowTurnParameters = SlowTurnParameters(rate=pi, time=0.5, smoothing=0.1)


@dataclass(frozen=True, slots=True)
class ClassicalParameters:
    """Method `classical`: the hexapod's washout with the parameter set of TU Delft (gains 0.6, critically damped).

    rotation_gain, tilt_gain: factors on body rates and on the specific force behind the tilt, per
        body axis.
    high_pass: natural frequencies of the rotation washout, rad/s: roll, pitch, yaw.
    tilt_low_pass: natural frequency behind the tilt, rad/s.
    tilt_rate: largest rate of the tilt, rad/s.
    angle_limit: of roll, pitch and yaw, rad, approached smoothly (assumed: 25 deg, as hexapods of
        60 inch stroke reach); infinite for none.
    """

    rotation_gain: Vec3 = (0.6, 0.6, 0.6)
    tilt_gain: Vec3 = (0.6, 0.6, 0.5)
    high_pass: Vec3 = (1.0, 0.8, 1.0)
    tilt_low_pass: float = 2.0
    tilt_rate: float = radians(3.0)
    angle_limit: float = radians(25.0)


@dataclass(frozen=True, slots=True)
class PreviewParameters:
    """Method `preview`: what the plan for a whole flight minimises, and how far it may turn the cabin beyond the vehicle.

    rate, smoothing: of the turn beyond the vehicle's own; rate in rad/s, and an acceleration of at
        most 2 rate / (e smoothing): as the slow turn of `blend` has them.
    force_unit, rate_unit: errors of specific force (m/s^2) and of angular rate (rad/s) that weigh
        the same: what a pilot begins to notice sideways and in roll (Reid & Nahon, UTIAS Report
            296, 1985).
    planning_rate: knots of the plan, Hz (assumed: far above the frequencies of what it may do).
    rounds: how often rotation and stage are planned both at once, after one for the other. Of the
        bundled flights one gains more than 1 % by the second round, and none by the third.
    """

    rate: float = radians(3.0)
    smoothing: float = 0.25
    force_unit: float = 0.17
    rate_unit: float = radians(3.0)
    planning_rate: float = 20.0
    rounds: int = 2

    @property
    def acceleration(self) -> float:
        """Largest acceleration of the turn beyond the vehicle's own, rad/s^2."""
        return 2.0 * self.rate / (e * self.smoothing)


@dataclass(frozen=True, slots=True)
class HorizonParameters:
    """How the stage plans ahead (`cueing.horizon`).

    planning_rate: plans per second, at least (assumed; 25 to 100 Hz made no difference of 0.3 % to
        the force error).
    length: from now to where every plan stands, s (assumed: braking is over by then, 3.5 / onset; 4
        to 7 s made no difference).
    blocks: pieces of constant jerk in a plan, short ones first (9 to 16 made no difference).
    fade: time constant with which the demand is thought to go on, s (assumed); it counts only where
        a limit is in the way.
    excess: the demand is limited smoothly at this many times what the onset filter could follow
        whatever came (found).
    memory: how far back it is looked to see what share of the demand is worth moving for, s
        (assumed; 8 to 30 s do).
    first_share: that share to begin with (found: more would cost where little is to be won).
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

    Per axis x, y, z of W.

    force_gain: factor on the demanded acceleration.
    onset: natural frequency of the braking high-pass, rad/s (found: lower is slower to brake and
        needs more travel; TU Delft's classical set has 0.8 to 1).
    recentre: corner of the return to the centre, rad/s; 0 for none beyond the high-pass. The return
        takes at most travel recentre^2 of acceleration, which at 0.2 rad/s and 1 m is 0.04 m/s^2,
        below the 0.063 (horizontal) and 0.154 m/s^2 (vertical) at which linear motion begins to be
        felt (Benson, Spencer & Stott, Aviation, Space and Environmental Medicine 57, 1986).
    bandwidth: corner of the low-pass on the demand, Hz (assumed).
    travel: no more than this of the platform's travel is used, m.
    horizon: how to plan ahead; None for the onset filter by itself, which has to be slower to move
        or quicker to brake (of it force_gain 0.4 with onset 2 did best).
    """

    force_gain: Vec3 = ONES
    onset: Vec3 = (0.7, 0.7, 0.7)
    recentre: Vec3 = (0.2, 0.2, 0.2)
    bandwidth: float = 5.0
    travel: Vec3 = (inf, inf, inf)
    horizon: HorizonParameters | None = HorizonParameters()


CLASSICAL_STAGE = StageParameters(
    (0.6, 0.6, 0.5),
    onset=(0.8, 1.0, 1.0),
    recentre=(0.0, 0.0, 0.2),
    travel=(0.6, 0.6, 0.6),
    horizon=None,
)
"""The TU Delft set for `classical`; the travel is assumed, that of a hexapod of 60 inch stroke."""

MethodParameters: TypeAlias = (
    AttitudeParameters | BlendParameters | ForceParameters | ClassicalParameters
)
