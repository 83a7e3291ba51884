"""Jumps of the attitude: a reset, reposition or trim in mid-run."""

# mypyc: runs every tick

from ..rotation import add, conjugate, exp, geodesic, multiply, scale
from .states import VehicleState


def attitude_jump(before: VehicleState, now: VehicleState) -> float:
    """Angle (rad) of the change of attitude between two states that the body rates do not explain.

    The rates are integrated by the trapezoid.
    """
    turned = multiply(conjugate(before.q_NB), now.q_NB)
    explained = scale(0.5 * (now.time - before.time), add(before.w_NB_B, now.w_NB_B))
    return geodesic(turned, exp(explained))
