"""What a user can choose about cueing; defaults carry their source."""

from dataclasses import dataclass
from math import radians

from ..rotation import Vec3

ONES: Vec3 = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class SlowTurnParameters:
    """The turn of the cabin that the vehicle does not make.

    rate: largest rate, rad/s. 3 deg/s is the customary limit (Groen & Bles, J. Vestibular Research 14, 2004).
    time: an error is taken back in about this time while the rate allows, s (assumed).
    smoothing: time constant of the critically damped filter on the rate, s (assumed). It bounds the acceleration of the
        turn to 2 rate / (e smoothing), reached when the rate flips from one limit to the other.
    """

    rate: float = radians(3.0)
    time: float = 1.0
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
    hold: the slow turn fades out where the specific force falls from twice this magnitude to it, m/s^2 (assumed).
    """

    rotation_gain: Vec3 = ONES
    hold: float = 1.5
    turn: SlowTurnParameters = SlowTurnParameters()


@dataclass(frozen=True, slots=True)
class StageParameters:
    """The stage: onsets of the acceleration that the rider's head should have, inside the travel.

    force_gain: factor on the demanded acceleration along x, y, z of W.
    onset: natural frequency of the braking high-pass, rad/s (assumed; TU Delft's classical set has 0.8 to 1).
    recentre: corner of the return to the centre, rad/s; the return takes at most travel recentre^2 of acceleration, which at
        0.2 rad/s and 1 m is 0.04 m/s^2, below the 0.063 (horizontal) and 0.154 m/s^2 (vertical) at which linear motion begins
        to be felt (Benson, Spencer & Stott, Aviation, Space and Environmental Medicine 57, 1986).
    bandwidth: corner of the low-pass on the demand, Hz (assumed).
    """

    force_gain: Vec3 = ONES
    onset: float = 1.5
    recentre: float = 0.2
    bandwidth: float = 5.0
