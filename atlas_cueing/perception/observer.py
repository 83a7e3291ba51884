"""What a head in the dark perceives of tilt and turn: an observer with a model of its own organs.

The brain is taken as an observer that knows canals, otoliths and gravity, predicts what they should
sense, and corrects itself by what they do sense (Merfeld, Young, Oman & Shelhamer, Journal of
Vestibular Research 3, 1993; Merfeld & Zupan, Journal of Neurophysiology 87, 2002). The gains are
those of Rader, Oman & Merfeld, Journal of Neurophysiology 102, 2009, table 4.

All vectors are in one set of right-handed axes fixed in the head, whichever: FRD and FLU give the
same perception. f is the specific force, w the angular rate, g = 9.80665 m/s^2. Merfeld writes it
for the gravito-inertial force g - a, which is -f. A hat stands for what the brain takes it for:

    u            up, a unit vector            f^ = g u + a^       the force that it expects
    c            the canals' output for w     c^ = w^ - v         the output that it expects

with v the low pass of w^ of the canals' time constant T, as the brain's model of the canals has no
adaptation. Three errors correct it, the last one the turn from the force sensed to the expected:

    a^ = -Ka (f - f^),   w^ = Kw (c - c^) + Kfw e,   e = angle(f, f^) (f x f^) / |f x f^|

The first is a loop without delay, and so is the second. Solved, with k = -Ka / (1 - Ka):

    f^ = k f + (1 - k) g u,   w^ = (Kw (c + v) + Kfw e) / (1 + Kw)

The perceived rate is w^ (1 + Kw) / Kw, which makes the gain at high frequencies 1 (the same factor
as in M. C. Newman, S.M. thesis, MIT, 2009). Gravity turns in the head against it:

    rate = c + v + (Kfw / Kw) e
    T v' = (Kw rate / (1 + Kw)) - v
    u' = -(rate + Kf e) x u

Without e, the canals' T cancels and the rate fades with (1 + Kw) T, velocity storage: 23 s. A
lasting force draws u with the rate (Kf + Kfw / Kw) e where the rate lets it.
"""

# mypyc: runs every tick

from dataclasses import dataclass
from math import atan2

from ..rotation import ZERO, Vec3, add, cross, dot, exp, norm, rotate, scale, subtract
from ..signals import STANDARD_GRAVITY
from .canals import Canals

_UP: Vec3 = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class ObserverParameters:
    """Gains of the observer (Rader, Oman & Merfeld 2009, table 4) and two constants.

    rate: Kw; turn: Kfw, 1/s; tilt: Kf, 1/s; acceleration: Ka, negative.
    time: of the canals as the brain knows them, s; that of `vestibular.CANALS`.
    faint: below this force, m/s^2, its direction fades: the otoliths' threshold in the dark
        (Benson, Spencer & Stott 1986); without it the direction of no force would be noise.
    """

    rate: float = 3.0
    turn: float = 2.0
    tilt: float = 2.0
    acceleration: float = -2.0
    time: float = 5.73
    faint: float = 0.063


OBSERVER = ObserverParameters()


class Observer:
    """A head that begins at rest with itself: used to its rate, the force taken for gravity.

    `up` is the perceived upward direction (unit vector) and `rate` the perceived angular rate
    (rad/s), both in the axes of f and w. Whatever finite f and w come, `up` stays a unit vector,
    and `rate` bounded by what the canals sense and 2 pi Kfw.

    The rates are straight between ticks, e goes on as it went before (Adams-Bashforth): the error
    is of second order in the tick.
    """

    def __init__(
        self, dt: float, f: Vec3, w: Vec3, parameters: ObserverParameters = OBSERVER
    ) -> None:
        """Begin with the lasting force f (m/s^2) and rate w (rad/s); ticks are dt (s) apart."""
        gain = -parameters.acceleration / (1.0 - parameters.acceleration)
        self._dt, self._faint = dt, parameters.faint
        self._own, self._expected = gain, (1.0 - gain) * STANDARD_GRAVITY
        self._turn, self._tilt = parameters.turn / parameters.rate, parameters.tilt
        self._share = parameters.rate / (1.0 + parameters.rate)
        self._half = 0.5 * dt / parameters.time
        self._canals = Canals(dt, w)
        self._sensed, self._stored = ZERO, ZERO
        self._error, self._error_before = ZERO, ZERO
        size = norm(f)
        self.up = scale(1.0 / size, f) if size > parameters.faint else _UP
        self.rate = ZERO

    def step(self, f: Vec3, w: Vec3) -> None:
        """Perceive the next tick: specific force f (m/s^2) and angular rate w (rad/s)."""
        error = subtract(scale(1.5, self._error), scale(0.5, self._error_before))
        sensed = self._canals.sense(w)
        middle = add(scale(0.5, add(self._sensed, sensed)), scale(self._turn, error))
        before = self._stored
        self._stored = self._store(before, middle)
        turning = add(middle, scale(0.5, add(before, self._stored)))
        self._carry(add(turning, scale(self._tilt, error)))
        self._sensed, self._error_before = sensed, self._error
        self._error = self._misled(f)
        self.rate = add(add(sensed, self._stored), scale(self._turn, self._error))

    def follow(self, motion: list[float]) -> list[float]:
        """Perceive the next ticks: force (m/s^2) and rate (rad/s), six numbers for each.

        Returns up and perceived rate (rad/s) after each, six numbers as well. Both lists are flat:
        a list for each tick would take half the time of all this.
        """
        perceived: list[float] = []
        for start in range(0, len(motion), 6):
            fx, fy, fz = motion[start], motion[start + 1], motion[start + 2]
            wx, wy, wz = motion[start + 3], motion[start + 4], motion[start + 5]
            self.step((fx, fy, fz), (wx, wy, wz))
            up, rate = self.up, self.rate
            perceived += [up[0], up[1], up[2], rate[0], rate[1], rate[2]]
        return perceived

    def _store(self, v: Vec3, middle: Vec3) -> Vec3:
        """Give v one tick on, by the trapezoid; `middle` is the rate less v half way, rad/s."""
        share, half = self._share, self._half
        loss = (1.0 - share) * half
        return scale(
            1.0 / (1.0 + loss), add(scale(1.0 - loss, v), scale(2.0 * half * share, middle))
        )

    def _carry(self, w: Vec3) -> None:
        """Turn `up` against the head's turn with the rate w (rad/s) for one tick."""
        up = rotate(exp(scale(-self._dt, w)), self.up)
        self.up = scale(1.0 / norm(up), up)

    def _misled(self, f: Vec3) -> Vec3:
        """Give e, the turn (rotation vector, rad) from the force f to the expected one."""
        across = scale(self._expected, cross(f, self.up))
        force, size = dot(f, f), norm(across)
        if size == 0.0:
            return ZERO
        angle = atan2(size, self._own * force + self._expected * dot(f, self.up))
        faint = self._faint * self._faint
        weight = 1.0 if force >= faint else force / faint
        return scale(weight * angle / size, across)
