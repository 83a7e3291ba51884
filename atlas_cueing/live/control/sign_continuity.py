"""Signs of quaternions that go on from tick to tick.

q and -q are the same orientation. Sources, cueing methods, trajectories and the guard's stop may
each use either; the log, the viewer and interpolation need one that does not jump. This is the only
place of the live run that chooses it.
"""

# mypyc: runs every tick

from ...rotation import IDENTITY, Quat, continuous
from ...signals import Cue, VehicleState


class SignContinuity:
    """Chooses the sign of each quaternion that lies nearer to the one before it."""

    def __init__(self, q_WS: Quat) -> None:
        """Start with the cue's orientation `q_WS` and a level vehicle that heads north."""
        self._q_WS = q_WS
        self._q_NB = IDENTITY

    def vehicle(self, vehicle: VehicleState) -> VehicleState:
        """Return the state of the vehicle with the sign of q_NB that goes on."""
        self._q_NB = continuous(vehicle.q_NB, self._q_NB)
        if self._q_NB == vehicle.q_NB:
            return vehicle
        return VehicleState(vehicle.time, self._q_NB, vehicle.w_NB_B, vehicle.f_B)

    def cue(self, cue: Cue) -> Cue:
        """Return the cue with the sign of q_WS that goes on."""
        self._q_WS = continuous(cue.q_WS, self._q_WS)
        if self._q_WS == cue.q_WS:
            return cue
        return Cue(cue.time, self._q_WS, cue.w_WS_W, cue.p_WS_W, cue.v_WS_W, cue.a_WS_W)
