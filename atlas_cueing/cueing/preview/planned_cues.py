"""The cues of a plan, tick by tick."""

import numpy as np

from ...errors import InputError
from ...rotations import Array
from ...signals import Cue, VehicleState


class PlannedCues:
    """Cues planned beforehand, given one after the other as `Cueing` gives its own."""

    def __init__(
        self, time: Array, q_WS: Array, w_W: Array, p_W: Array, v_W: Array, a_W: Array
    ) -> None:
        """One row for each tick; SI, names and frames as in `Cue`."""
        self._time, self._rows = time, np.hstack([q_WS, w_W, p_W, v_W, a_W])
        self._tick = 0

    def step(self, vehicle: VehicleState) -> Cue:
        """Give the cue for the next of the vehicle states that were planned for.

        Raises InputError for any other state.
        """
        if self._tick == len(self._time) or vehicle.time != self._time[self._tick]:
            raise InputError(
                f"method 'preview' planned for other states: there is none at {vehicle.time} s in"
                " this place"
            )
        q0, q1, q2, q3, *rest = self._rows[self._tick].tolist()
        wx, wy, wz, px, py, pz, vx, vy, vz, ax, ay, az = rest
        self._tick += 1
        return Cue(
            vehicle.time, (q0, q1, q2, q3), (wx, wy, wz), (px, py, pz), (vx, vy, vz), (ax, ay, az)
        )
