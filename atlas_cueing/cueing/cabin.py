"""The cabin: how it stands in W, and how it turns with the vehicle and slowly by itself."""

# mypyc: runs every tick

from dataclasses import dataclass
from math import radians

from ..rotation import (
    ZERO,
    Quat,
    Vec3,
    add,
    cross,
    exp,
    flip,
    flip_rotation,
    from_euler,
    integrate_body,
    multiply,
    norm,
    normalise,
    rotate,
    scale,
    subtract,
    to_euler,
)
from ..signals import VehicleState
from .damping import DampedVector
from .parameter import Parameter, Range


@dataclass(frozen=True, slots=True)
class SlowTurnParameters:
    """The turn of the cabin that the vehicle does not make: rate in rad/s, times in s.

    `slow_turn` says what each is. The acceleration of the turn stays below 2 rate / (e smoothing),
    reached when the rate flips from one limit to the other.
    """

    rate: float = radians(3.0)
    time: float = 2.0
    smoothing: float = 0.25


SLOW_TURN = SlowTurnParameters()
CUSTOMARY = "3 deg/s is the customary limit (Groen & Bles, J. Vestibular Research 14, 2004)"


def slow_turn(verb: str, fastest: float, source: str = CUSTOMARY) -> tuple[Parameter, ...]:
    """Declare the parameters of a method's field `turn`, of type SlowTurnParameters.

    Args:
        verb: what the turn does, which begins the keys.
        fastest: upper end of the range of its rate, deg/s.
        source: where the default of the rate comes from.

    """
    return (
        Parameter(
            f"{verb}_rate_deg_s",
            "turn.rate",
            Range(0.0, fastest, above=True),
            "largest rate of the turn that the vehicle does not make",
            source,
        ),
        Parameter(
            f"{verb}_time_s",
            "turn.time",
            Range(0.01, 1000.0),
            "an error is taken back in about this time while the rate allows",
            "assumed",
        ),
        Parameter(
            f"{verb}_smoothing_s",
            "turn.smoothing",
            Range(0.01, 1000.0),
            "time constant of the critically damped filter on the rate",
            "assumed",
        ),
    )


class SlowTurn:
    """Rate at which the cabin takes back an error without being noticed.

    The wish error / time + w, at most `rate` long, passes a critically damped filter in cabin axes.
    The filter keeps the rate inside the ball of its wishes and its derivative below 2 rate / (e
    smoothing); both bounds hold for any error.
    """

    def __init__(self, dt: float, parameters: SlowTurnParameters) -> None:
        """Start at rest; dt in s."""
        self._rate, self._time = parameters.rate, parameters.time
        self._damped = DampedVector(1.0 / parameters.smoothing, dt, ZERO)

    def step(self, error: Vec3, w: Vec3) -> Vec3:
        """Give the rate (rad/s, S) one tick on.

        error: rotation vector still to go (rad, S); w: the lasting rate (rad/s, S).
        """
        wish = add(scale(1.0 / self._time, error), w)
        return self._damped.step(limited(wish, self._rate))


def limited(v: Vec3, most: float) -> Vec3:
    """Give the vector v, shortened to the length `most` where it is longer."""
    size = norm(v)
    return v if size <= most else scale(most / size, v)


class FreeCabin:
    """Orientation q_WS that turns with a given rate plus an extra one.

    Integrated, so that it can go on for ever.
    """

    def __init__(self, dt: float, q_WS: Quat, w_S: Vec3) -> None:
        """Begin in q_WS, turning with w_S (rad/s, S); dt in s."""
        self._dt, self.q_WS, self._w_S = dt, q_WS, w_S
        self._w_extra, self._carried = ZERO, ZERO

    def carry(self, w_S: Vec3) -> None:
        """Turn for one tick with the rate w_S (rad/s, S): `integrate_body` of both ends of it."""
        before, self._w_S = self._w_S, w_S
        self._carried = scale(0.5 * self._dt, add(before, w_S))
        self.q_WS = integrate_body(self.q_WS, self._carried, before, w_S, self._dt)

    def turn(self, w_extra: Vec3) -> None:
        """Turn for the same tick with the extra rate w_extra (rad/s, S), by the trapezoid.

        After `carry` with h, it turns by e - h x e / 2: both at once, to second order.
        """
        before, self._w_extra = self._w_extra, w_extra
        extra = scale(0.5 * self._dt, add(before, w_extra))
        extra = subtract(extra, scale(0.5, cross(self._carried, extra)))
        self.q_WS = normalise(multiply(self.q_WS, exp(extra)))

    @property
    def cue(self) -> tuple[Quat, Vec3]:
        """The orientation q_WS and the rate w_WS_W (rad/s)."""
        return self.q_WS, rotate(self.q_WS, add(self._w_S, self._w_extra))


class Cabin(FreeCabin):
    """A cabin whose extra rate is the slow turn."""

    def __init__(self, dt: float, q_WS: Quat, w_S: Vec3, parameters: SlowTurnParameters) -> None:
        """Begin in q_WS, turning with w_S (rad/s, S); dt in s."""
        super().__init__(dt, q_WS, w_S)
        self._slow = SlowTurn(dt, parameters)

    def correct(self, error_S: Vec3, w_S: Vec3 = ZERO) -> None:
        """Turn slowly for the tick that it was carried for.

        error_S: rotation vector that is then left (rad, S); w_S: the lasting rate (rad/s, S).
        """
        self.turn(self._slow.step(error_S, w_S))


def upright(q_NB: Quat) -> Quat:
    """Give q_WS of a cabin that stands in W as the vehicle does in N.

    W's x lies along the vehicle's heading.
    """
    heading = to_euler(q_NB)[0]
    return flip_rotation(multiply(from_euler(-heading, 0.0, 0.0), q_NB))


def cabin_rate(gain: Vec3, vehicle: VehicleState) -> Vec3:
    """Give the vehicle's body rates as the cabin's (rad/s, S), with a gain for each axis of S."""
    x, y, z = flip(vehicle.w_NB_B)
    return (gain[0] * x, gain[1] * y, gain[2] * z)
