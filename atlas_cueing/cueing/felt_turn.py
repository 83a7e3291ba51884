"""The turn that the vehicle does not make, limited by what of it is felt.

Semicircular canals of time constant T turn an extra rate z + y into y, where z' = y / T: z is what
the rider has grown used to, y what is felt. With w the extra rate that would stay with the force
and e the misalignment left, e' = w - z - y; for a constant w and s = w - z the two states obey

    e' = s - y,   s' = -y / T

and the integral of lambda^2 e^2 + y^2 is least for y = lambda e + k s (`lasting_gain`). Where w is
expected to decay, w' = -w / tau, less of it is met beforehand: y = lambda e + k_w w - k z
(`decaying_gain`).
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import inf, pi, radians, sqrt

from ..rotation import ZERO, Vec3, add, norm, scale, subtract
from .cabin import limited
from .damping import DampedVector
from .parameter import Parameter, Range


@dataclass(frozen=True, slots=True)
class FeltTurnParameters:
    """Parameters of `FeltTurn`: rates in rad/s, times in s; FELT_TURN_KEYS says what each is."""

    response: float = 1.0
    canals: float = 5.73
    lasting: float = inf
    felt: float = radians(5.0)
    rate_gain: float = 0.2
    error_gain: float = 0.3
    extra: float = pi
    smoothing: float = 0.1


FELT_TURN = FeltTurnParameters()

FELT_BOUND_KEYS = (
    Parameter(
        "canals_s",
        "turn.canals",
        Range(1.0, 1e6),
        "time constant with which the canals lose a lasting rate",
        "5.73 s (Telban & Cardullo, NASA/CR-2005-213747)",
    ),
    Parameter(
        "felt_rate_deg_s",
        "turn.felt",
        Range(0.0, 90.0, above=True),
        "largest felt part of the extra rate, of an aligned cabin beside a vehicle at rest",
        "found; 3 to 8 made no difference",
    ),
    Parameter(
        "felt_rate_gain",
        "turn.rate_gain",
        Range(0.0, 1.0),
        "what the vehicle's rate adds to that, as a share of it: a scaled cue is no false cue",
        "found",
    ),
    Parameter(
        "felt_error_gain_per_s",
        "turn.error_gain",
        Range(0.0, 10.0),
        "what the misalignment adds to that: a false force is worse than a false rate",
        "found; 0.2 to 0.5 made no difference",
    ),
    Parameter(
        "extra_rate_deg_s",
        "turn.extra",
        Range(0.0, 720.0, above=True),
        "largest rate that is wished for beyond the vehicle's, felt or not",
        "assumed: half a turn a second, as fast as the wheels of Atlas",
    ),
    Parameter(
        "smoothing_s",
        "turn.smoothing",
        Range(0.01, 1000.0),
        "time constant of the critically damped filter on the felt part",
        "assumed",
    ),
)
"""Declares what bounds a turn of type FeltTurnParameters in a method's field `turn`."""

FELT_TURN_KEYS = (
    Parameter(
        "response_rad_s",
        "turn.response",
        Range(0.01, 10.0),
        "felt rate that an error is worth, for each rad of it",
        "found; 0.7 to 2 made no difference",
    ),
    Parameter(
        "lasting_s",
        "turn.lasting",
        Range(0.01, 1e6),
        "time constant with which the rate that stays with the force is expected to decay",
        "none: as if for ever",
    ),
    *FELT_BOUND_KEYS,
)
"""Declares a method's field `turn` of type FeltTurnParameters."""


def lasting_gain(response: float, canals: float) -> float:
    """Give the gain k of the lasting rate, T (sqrt(lambda^2 + 2 lambda / T) - lambda).

    It solves the Riccati equation, and goes to 1 for endless canals, which feel every rate. The
    quotient below is the same number without the difference.

    Args:
        response: lambda, rad/s.
        canals: T, s.

    """
    return 2.0 * response / (sqrt(response * response + 2.0 * response / canals) + response)


def decaying_gain(response: float, canals: float, lasting: float) -> float:
    """Give the gain k_w of a rate w that decays with the time constant tau.

    With w as a third state of the same problem, and a = 1 / tau,

        k_w = lambda (a + k / T) / (a^2 + a (lambda + k / T) + lambda / T)

    It is below `lasting_gain`, and that for tau without end.

    Args:
        response: lambda, rad/s.
        canals: T, s.
        lasting: tau, s.

    """
    k, a = lasting_gain(response, canals), 1.0 / lasting
    if a == 0.0:
        return k
    return response * (a + k / canals) / (a * a + a * (response + k / canals) + response / canals)


class FeltTurn:
    """Extra rate z + y whose felt part y is lambda e + k_w w - k z within its bound.

    The bound on the wish is felt + rate_gain |w_vehicle| + error_gain |e|. The filter keeps y in
    the convex hull of its wishes, so the bound holds for y as well, for any input: canals sense no
    more of the extra rate than the largest bound so far. A wish that would take z + y beyond
    `extra` is cut first, which z + y keeps to but for the lag of the filter: 2 smoothing / canals
    of it, 3.5 %.
    """

    def __init__(self, dt: float, parameters: FeltTurnParameters) -> None:
        """Start at rest, with a rider used to rest; dt in s."""
        self._parameters = parameters
        self._half = 0.5 * dt / parameters.canals
        self._used_to_gain = lasting_gain(parameters.response, parameters.canals)
        self._lasting_gain = decaying_gain(
            parameters.response, parameters.canals, parameters.lasting
        )
        self._felt = DampedVector(1.0 / parameters.smoothing, dt, ZERO)
        self._used_to = ZERO

    def step(self, error: Vec3, lasting: Vec3, vehicle: Vec3) -> Vec3:
        """Give the extra rate (rad/s, S) one tick on.

        Args:
            error: rotation vector still to go (rad, S).
            lasting: extra rate that would stay with the force (rad/s, S).
            vehicle: rate of the vehicle as the cabin has it (rad/s, S).

        """
        parameters, before = self._parameters, self._felt.x
        ahead = scale(self._lasting_gain, lasting)
        back = scale(self._used_to_gain, self._used_to)
        wish = add(scale(parameters.response, error), subtract(ahead, back))
        whole = limited(add(self._used_to, wish), parameters.extra)
        felt = self._felt.step(limited(subtract(whole, self._used_to), self._bound(error, vehicle)))
        self._used_to = add(self._used_to, scale(self._half, add(before, felt)))
        return add(self._used_to, felt)

    def _bound(self, error: Vec3, vehicle: Vec3) -> float:
        """Give the largest felt rate (rad/s) that may be wished for now."""
        parameters = self._parameters
        more = parameters.rate_gain * norm(vehicle) + parameters.error_gain * norm(error)
        return min(parameters.felt + more, parameters.extra)
