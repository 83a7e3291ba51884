"""Drives that carry a simulated platform: they follow set points, and tell what is measured.

The receiver is the reference; behind it, servos turn the wheels of a plant that slips. So the whole
loop runs, set points out and statuses back, with a plant in place of hardware.
"""

from array import array
from collections.abc import Sequence
from contextlib import suppress
from math import nan

import numpy as np

from ..errors import SetPointError
from ..plant import PLANT_ROW, RealTimePlant
from ..rotation import Vec3
from ..rotations import Array
from ..scenario import Platform
from ..scenario.plant_table import PlantTable
from .control import CabinSensors
from .control.command import axes_of
from .control.pose import Pose
from .output import SetPointReceiver, StatusSender, limits_hash
from .output.hello import is_hello
from .output.sealing import Address
from .output.setpoint import decode

STEP_NS = 2_000_000  # from one look at the set points to the next
_KEPT = 2  # steps from one row that is kept to the next
_AHEAD_NS = 90_000_000  # of a set point that comes; none is taken 0.1 s ahead


class PlantDrives:
    """Receiver, plant and sensors, at any clock whose times do not decrease.

    receiver: of the set points.
    """

    def __init__(
        self,
        platform: Platform,
        start: int,
        pose: Pose | None = None,
        table: PlantTable | None = None,
    ) -> None:
        """Stand at `pose` (at home by default) at `start`, ns.

        Raises InputError for a platform that makes no plant.
        """
        pose = pose or Pose()
        limits = platform.wheel_limit_values(), platform.stage_limit_values()
        self._axes = [(p, 0.0, 0.0) for p in (*pose.wheel_angle, *pose.p_WS_W)]
        self._plant = RealTimePlant(platform, table, pose.q_WS, self._axes)
        self.receiver = SetPointReceiver(*limits, place=pose.p_WS_W)
        self._status = StatusSender(self.receiver, limits_hash(*limits), platform=self)
        self._start = self._now = start
        self._steps = 0
        self._said: list[tuple[bytes, Address]] = []
        self._rows = array("d")

    def wheel_angle(self) -> Vec3:
        """Return the angle of each wheel, rad."""
        return self._plant.wheel_angle

    def sensors(self) -> CabinSensors:
        """Return what the sensors of the cabin tell."""
        fix = self._plant.fix
        if fix is None:
            return CabinSensors(self._plant.turned)
        return CabinSensors(self._plant.turned, self._start + round(1e9 * fix[0]), fix[1])

    @property
    def rows(self) -> Array:
        """What the plant did up to now, every 4 ms (m, 2 + PLANT_ROW).

        Time (ns), time of the run (s; NaN before the first set point) and `RealTimePlant.row`.
        """
        return np.array(self._rows).reshape(-1, 2 + PLANT_ROW)

    def take(self, packet: bytes, sender: Address) -> str:
        """Take a packet that has come; return why it was refused, or ''.

        Drives of their own are punctual, and these may be held up by the machine: they go on first
        to where a set point would not be too far ahead.
        """
        if is_hello(packet):
            return self._status.hear(packet, sender, self._now)
        with suppress(SetPointError):
            self._go_on(decode(packet).due - _AHEAD_NS)
        return self.receiver.take(packet, sender, self._now)

    def go_on(self, now: int) -> Sequence[tuple[bytes, Address]]:
        """Go on to `now` (ns); return the statuses to be sent, each with its address."""
        self._go_on(now)
        said, self._said = self._said, []
        return said

    def _go_on(self, now: int) -> None:
        while self._now + STEP_NS <= now:
            self._now += STEP_NS
            command = self.receiver.at(self._now)
            self._axes = self._axes if command is None else axes_of(command)
            self._plant.advance(self._axes, 1e-9 * STEP_NS)
            self._steps += 1
            if self._steps % _KEPT == 0:
                self._keep()
            self._said += self._status.due(self._now)

    def _keep(self) -> None:
        newest, time = self.receiver.newest, nan
        if newest:
            time = newest.command.time + 1e-9 * (self._now - newest.due)
        self._rows.extend((float(self._now), time, *self._plant.row()))
