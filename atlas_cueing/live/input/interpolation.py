"""The state of the vehicle between two samples."""

# mypyc: runs every tick

from ...rotation import (
    Quat,
    Vec3,
    add,
    conjugate,
    exp,
    integrate_body,
    log,
    multiply,
    scale,
    subtract,
)
from ...signals import VehicleState


class Interpolation:
    """Interpolates between the samples `before` and `now`, which must be later.

    Rates and force are linear in time. The attitude is the integral of these rates (fourth-order
    Magnus expansion), and what is then missing at `now` is spread evenly: q and w meet both
    samples, and q' departs from w by a constant.

    A cubic through attitudes and rates would make q' = w, but it takes the forward-Euler attitude
    of JSBSim at its word: for a steady angular acceleration a its own swings between -2 a and 4 a
    in every interval.
    """

    def __init__(self, before: VehicleState, now: VehicleState) -> None:
        self._before, self._h = before, now.time - before.time
        self._rate_gain = subtract(now.w_NB_B, before.w_NB_B)
        self._force_gain = subtract(now.f_B, before.f_B)
        explained = turned(before.q_NB, before.w_NB_B, self._rate_gain, self._h)
        self._missing = log(multiply(conjugate(explained), now.q_NB))

    def at(self, time: float, called: float) -> VehicleState:
        """Return the state at `time` (s), from one sample to the other, with `called` as its time.

        Its q_NB has the sign that goes on from `before`.
        """
        before = self._before
        s = (time - before.time) / self._h
        gain = scale(s, self._rate_gain)
        q_NB = multiply(
            turned(before.q_NB, before.w_NB_B, gain, time - before.time),
            exp(scale(s, self._missing)),
        )
        return VehicleState(
            called, q_NB, add(before.w_NB_B, gain), add(before.f_B, scale(s, self._force_gain))
        )


def turned(q_NB: Quat, w_B: Vec3, gain_B: Vec3, dt: float) -> Quat:
    """Return the attitude `dt` s later, at a body rate linear from w_B to w_B + gain_B (rad/s)."""
    turn = (
        dt * (w_B[0] + 0.5 * gain_B[0]),
        dt * (w_B[1] + 0.5 * gain_B[1]),
        dt * (w_B[2] + 0.5 * gain_B[2]),
    )
    return integrate_body(q_NB, turn, w_B, add(w_B, gain_B), dt)
