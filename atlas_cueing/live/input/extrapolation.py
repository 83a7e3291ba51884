"""The state of the vehicle after its last sample, without a step when the next one comes."""

from math import exp as exponential

from ...rotation import (
    ZERO,
    Quat,
    Vec3,
    add,
    conjugate,
    exp,
    log,
    multiply,
    norm,
    scale,
    subtract,
)
from ...signals import VehicleState
from .interpolation import turned

# s in which an extrapolated acceleration fades, once the next sample is overdue (assumed)
FADING = 0.025
STEEPEST_RATE = 100.0  # rad/s^2; a small quadrotor's best (assumed)
# m/s^3; an elevator kicked over in 0.1 s makes 200, what is steeper is an impact (assumed)
STEEPEST_FORCE = 300.0


class Extrapolation:
    """Extrapolates the state of the vehicle from the samples up to now.

    From a sample on, body rates and force go on as they did from the one before: with a constant
    slope for as long as the last interval was, and with one that fades out exponentially after it.
    So both tend to a constant however late the next sample is, and are bounded for ever. Slopes
    steeper than those of a manoeuvre are cut: an impact does not go on.

    A new sample corrects the prediction. The error at the last returned state is added to the new
    prediction, shrinking linearly to nothing over one interval: attitude, rates and force go on
    without a step. The correction of the attitude is not put into the rates, or every error of a
    sample's time would come out as an angular acceleration. The sign of the attitude's quaternion
    is arbitrary.
    """

    def __init__(self, sample: VehicleState, interval: float) -> None:
        """Start at a sample, with constant rates and force; the next is due `interval` s later."""
        self._sample, self._interval = sample, interval
        self._slope_w, self._slope_f = ZERO, ZERO
        self._last = sample  # returned
        self._corrected = sample.time  # when the correction began
        self._error_q, self._error_w, self._error_f = ZERO, ZERO, ZERO

    def add(self, sample: VehicleState) -> None:
        """Take a later sample of the same motion."""
        interval = sample.time - self._sample.time
        self._slope_w = _slope(self._sample.w_NB_B, sample.w_NB_B, interval, STEEPEST_RATE)
        self._slope_f = _slope(self._sample.f_B, sample.f_B, interval, STEEPEST_FORCE)
        self._sample, self._interval = sample, interval
        last = self._last
        q_NB, w_B, f_B = self._prediction(last.time)
        self._error_q = log(multiply(conjugate(q_NB), last.q_NB))
        self._error_w, self._error_f = subtract(last.w_NB_B, w_B), subtract(last.f_B, f_B)
        self._corrected = last.time

    def at(self, time: float) -> VehicleState:
        """Return the state at `time` (s), which does not decrease from call to call."""
        q_NB, w_B, f_B = self._prediction(time)
        left = 1.0 - (time - self._corrected) / self._interval
        if left > 0.0:
            q_NB = multiply(q_NB, exp(scale(left, self._error_q)))
            w_B = add(w_B, scale(left, self._error_w))
            f_B = add(f_B, scale(left, self._error_f))
        self._last = VehicleState(time, q_NB, w_B, f_B)
        return self._last

    def _prediction(self, time: float) -> tuple[Quat, Vec3, Vec3]:
        """Predict attitude, rates and force at `time` from the last two samples alone."""
        sample, dt = self._sample, time - self._sample.time
        late = dt - self._interval
        if late <= 0.0:
            gain = scale(dt, self._slope_w)
            q_NB = turned(sample.q_NB, sample.w_NB_B, gain, dt)
            return q_NB, add(sample.w_NB_B, gain), add(sample.f_B, scale(dt, self._slope_f))
        due = add(sample.w_NB_B, scale(self._interval, self._slope_w))
        q_NB = turned(sample.q_NB, sample.w_NB_B, subtract(due, sample.w_NB_B), self._interval)
        # integral of the fading slope and of what it has become: tau (1 - e^(-t / tau)), and tau t
        # less tau times that
        reach = FADING * (1.0 - exponential(-late / FADING))
        mean = FADING * (late - reach) / late
        q_NB = multiply(q_NB, exp(scale(late, add(due, scale(mean, self._slope_w)))))
        return (
            q_NB,
            add(due, scale(reach, self._slope_w)),
            add(sample.f_B, scale(self._interval + reach, self._slope_f)),
        )


def _slope(before: Vec3, now: Vec3, interval: float, steepest: float) -> Vec3:
    """Return the change per second, cut to the length `steepest`."""
    change = subtract(now, before)
    return scale(1.0 / max(interval, norm(change) / steepest), change)
