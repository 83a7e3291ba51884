"""The test for a discontinuity between two samples: a reset, repositioned or crashed vehicle."""

# mypyc: runs every tick

from math import degrees, radians

from ...rotation import norm, subtract
from ...signals import VehicleState, attitude_jump

JUMP_ANGLE = radians(0.5)  # rad beyond what the rates explain, as in batch runs (assumed)
# m/s^2 from one sample to the next, 2 g: a hard landing may pass for a crash (assumed)
JUMP_FORCE = 20.0
# rad/s^2 that a forward-Euler model may leave out of its rates (assumed: a hard manoeuvre)
ANGULAR_ACCELERATION = 20.0
LONGEST_EXPLAINED = 0.1  # s; over a longer gap rates explain no more than over this one


def discontinuity(before: VehicleState, now: VehicleState, jitter: float = 0.0) -> str:
    """Describe why `now` does not follow from `before`; empty when it does.

    The attitude may differ from what the rates of both explain by JUMP_ANGLE, by what an angular
    acceleration makes of their distance h in time (a h^2 / 2), and by what an error of `jitter` (s)
    in that distance makes of the rate.
    """
    h = min(now.time - before.time, LONGEST_EXPLAINED)
    rate = max(norm(before.w_NB_B), norm(now.w_NB_B))
    allowed = JUMP_ANGLE + 0.5 * ANGULAR_ACCELERATION * h * h + rate * jitter
    jump = attitude_jump(before, now)
    if jump > allowed:
        return (
            f"attitude jumped by {degrees(jump):.3g} deg that the body rates do not explain,"
            f" allowed: {degrees(allowed):.3g}"
        )
    force = norm(subtract(now.f_B, before.f_B))
    if force > JUMP_FORCE:
        return (
            f"force jumped by {force:.3g} m/s^2 from one sample to the next, allowed:"
            f" {JUMP_FORCE:g}"
        )
    return ""
