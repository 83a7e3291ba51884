"""Where the sphere is, as a gyro and late fixes tell.

Between fixes the gyro, less its bias, is integrated. A fix of time t_m is compared with the
estimate of that time:

    e = log(q_fix q_hat(t_m)^-1)  in W
    q_hat <- exp(k_q e) q_hat,  b <- b - k_b R^T e / T

The first fixes count more, because the bias is not known yet: the n-th (from 0) has the gains of a
filter whose memory grows (Brookner, Tracking and Kalman Filtering Made Easy, 1998, 1.2.10),
    k_q = 4 / (n + n_0),  k_b = 6 / (n + n_0)^2,
with n_0 by the gain of the first, until these have fallen to those of the long run.

An error on the left stays the same as the sphere turns (q_hat(t) = q_hat(t_m) times what the gyro
saw since), so the late fix corrects the present estimate by the same e.
"""

# mypyc: runs every tick

from typing import Final

from ..rotation import Quat, Vec3, conjugate, exp, log, multiply, rotate, scale

_SAME: Final = 1e-6  # s
_BIAS: Final = 6.0 / 16.0  # k_b / k_q^2 of a memory that grows


class AttitudeObserver:
    """gain and bias_gain: shares of a fix, 0 to 1; a fix every `period` s; memory in s.

    first_gain: share of the first fix; nothing falls from there if it is not above `gain`.
    """

    def __init__(
        self,
        q_WS: Quat,
        gain: float,
        bias_gain: float,
        period: float,
        memory: float,
        first_gain: float = 0.0,
    ) -> None:
        """Start at a known orientation, at time 0."""
        self.q_WS = q_WS
        self.bias_S: Vec3 = (0.0, 0.0, 0.0)
        self._gain: Final[float] = gain
        self._bias_gain: Final[float] = bias_gain
        self._period: Final[float] = period
        self._falling = first_gain
        self._memory: Final[float] = memory
        self._past: list[tuple[float, Quat]] = [(0.0, q_WS)]

    def turn(self, time: float, rate_S: Vec3, dt: float) -> None:
        """Take the gyro's rate (rad/s, S) over the dt (s) that end at `time` (s)."""
        b = self.bias_S
        turn = (rate_S[0] - b[0], rate_S[1] - b[1], rate_S[2] - b[2])
        self.q_WS = multiply(self.q_WS, exp(scale(dt, turn)))
        self._past.append((time, self.q_WS))
        while self._past[0][0] < time - self._memory:
            del self._past[0]

    def at(self, time: float) -> Quat | None:
        """Return the estimate of `time` (s); None before the memory, and after the last turn."""
        before = None
        for t, q in self._past:
            if abs(t - time) < _SAME:
                return q
            if t > time:
                return None if before is None else _between(before, (t, q), time)
            before = (t, q)
        return None

    def take_fix(self, time: float, fix_WS: Quat) -> None:
        """Take a fix that was seen at `time` (s); one that is older than the memory is dropped."""
        then = self.at(time)
        if then is None:
            return
        error = log(multiply(fix_WS, conjugate(then)))
        gain = max(self._gain, self._falling)
        k = max(self._bias_gain, _BIAS * self._falling * self._falling) / self._period
        self._falling /= 1.0 + 0.25 * self._falling
        pull = exp(scale(gain, error))
        self.q_WS = multiply(pull, self.q_WS)
        # what is compared next must know of this pull
        self._past = [(t, multiply(pull, q)) for t, q in self._past]
        e, b = rotate(conjugate(then), error), self.bias_S
        self.bias_S = (b[0] - k * e[0], b[1] - k * e[1], b[2] - k * e[2])


def _between(one: tuple[float, Quat], other: tuple[float, Quat], time: float) -> Quat:
    """The orientation at `time` of a constant rate from one (time, q_WS) to the other."""
    share = (time - one[0]) / (other[0] - one[0])
    return multiply(one[1], exp(scale(share, log(multiply(conjugate(one[1]), other[1])))))
