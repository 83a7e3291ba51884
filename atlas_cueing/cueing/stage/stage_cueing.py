"""What the stage should do: part of the acceleration that the rider's head lacks.

A rider feels f = R_SW (a_head - g_W), so the head should have a_head = R_WS f_vehicle + g_W. For a
head off the centre the sphere's own turning gives alpha x r + w x (w x r) of it; the rest is asked
of the stage, and each axis does with it what its planner can inside the travel (`mpc` or
`high_pass`).
"""

# mypyc: runs every tick

from typing import TypeAlias, assert_never

from ...rotation import ZERO, Quat, Vec3, add, cross, flip, rotate, scale, subtract
from ...signals import STANDARD_GRAVITY, StageLimits
from .high_pass import HighPass, demand_bound
from .mpc import MpcAxis
from .stage_parameters import StageParameters

_GRAVITY_W: Vec3 = (0.0, 0.0, -STANDARD_GRAVITY)


StageAxis: TypeAlias = MpcAxis | HighPass
"""One axis of the stage: `step` gives position (m), velocity and acceleration one tick on, for a
demand in m/s^2."""


class StageCueing:
    """Motion of the stage for the cue's orientation and the vehicle's specific force."""

    def __init__(
        self, dt: float, parameters: StageParameters, limits: StageLimits, head_S: Vec3
    ) -> None:
        """Start at rest in the centre.

        head_S: the rider's head from the sphere's centre, m, in S; dt in s.
        """
        self._dt, self._gain = dt, parameters.force_gain
        self._head, self._centred = head_S, head_S == ZERO
        self._axes: tuple[StageAxis, StageAxis, StageAxis] = (
            _axis(0, dt, parameters, limits),
            _axis(1, dt, parameters, limits),
            _axis(2, dt, parameters, limits),
        )
        self._w_before: Vec3 | None = None

    def step(self, q_WS: Quat, w_WS_W: Vec3, f_B: Vec3) -> tuple[Vec3, Vec3, Vec3]:
        """Give position (m), velocity (m/s) and acceleration (m/s^2) of the stage in W.

        q_WS and w_WS_W (rad/s): the rotation of the cue; f_B: the vehicle's specific force (m/s^2,
        FRD).
        """
        wanted = add(rotate(q_WS, flip(f_B)), _GRAVITY_W)
        lacking = subtract(wanted, self._turning(q_WS, w_WS_W))
        gain, axes = self._gain, self._axes
        x = axes[0].step(gain[0] * lacking[0])
        y = axes[1].step(gain[1] * lacking[1])
        z = axes[2].step(gain[2] * lacking[2])
        return (x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2])

    def _turning(self, q_WS: Quat, w_WS_W: Vec3) -> Vec3:
        """Acceleration of the head (W) that the sphere's turning makes."""
        before = w_WS_W if self._w_before is None else self._w_before
        self._w_before = w_WS_W
        if self._centred:
            return ZERO
        r = rotate(q_WS, self._head)
        alpha = scale(1.0 / self._dt, subtract(w_WS_W, before))
        return add(cross(alpha, r), cross(w_WS_W, cross(w_WS_W, r)))


def _axis(i: int, dt: float, parameters: StageParameters, limits: StageLimits) -> StageAxis:
    """Make the planner of axis i."""
    onset, recentre, bandwidth = parameters.onset[i], parameters.recentre[i], parameters.bandwidth
    travel = min(limits.travel[i], parameters.travel[i])
    speed, acceleration = limits.speed[i], limits.acceleration[i]
    match parameters.planner:
        case "onset":
            bound = demand_bound(onset, travel, speed, acceleration)
            return HighPass(dt, onset, recentre, bandwidth, bound)
        case "horizon":
            limit = travel, speed, acceleration, limits.jerk[i]
            return MpcAxis(dt, onset, recentre, bandwidth, limit, parameters.mpc, i)
    assert_never(parameters.planner)
