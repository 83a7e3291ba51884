"""Whether a motion has come to rest, and where."""

# mypyc: runs every tick

from math import hypot

from ...rotation import ZERO
from ...signals import Motion
from .pose import Pose

# rad/s, m/s, and a tenth of it per s^2: below this the platform is at rest (assumed: imperceptible)
AT_REST = 1e-3


def is_still(motion: Motion) -> bool:
    """Return whether a motion is exactly at rest."""
    return not any((*motion.w_WS_W, *motion.alpha_WS_W, *motion.v_WS_W, *motion.a_WS_W))


def is_at_rest(motion: Motion) -> bool:
    """Return whether nobody would notice that a motion is not at rest."""
    rate, bend = hypot(*motion.w_WS_W, *motion.v_WS_W), hypot(*motion.alpha_WS_W, *motion.a_WS_W)
    return rate < AT_REST and bend < 10.0 * AT_REST


def is_at_home(motion: Motion) -> bool:
    """Return whether a motion is upright in the centre."""
    return Pose(motion.q_WS, ZERO, motion.p_WS_W).is_home
