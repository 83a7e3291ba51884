"""Rides on a simulated platform that slips, on a virtual clock."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from atlas_cueing.live.control.command import Command
from atlas_cueing.live.control.drive_status import CabinSensors, DriveStatus
from atlas_cueing.live.output import hello, status
from atlas_cueing.live.output.hello import Hello, limits_hash
from atlas_cueing.live.output.setpoint import encode
from atlas_cueing.live.plant_drives import PlantDrives
from atlas_cueing.rotation import Quat, Vec3, exp, geodesic, multiply

from .rig import Rig
from .virtual_drives import QUICK, SENDER

PLATFORM = "atlas-2.9m-halo"
Sensed = Callable[[int, CabinSensors], CabinSensors | None]


class PlantRide:
    """The loop with a plant in place of hardware.

    sensed: what is made of the sensors' words, by the number of the status.
    truth: orientation of the sphere at the due time of each set point.
    """

    session = 7
    refusal = ""

    def __init__(
        self,
        corrected: str,
        rate: float = 100.0,
        seconds: float = 8.0,
        lead: float = 0.04,
        sensed: Sensed = lambda _, sensors: sensors,
        turning: float = 0.9,
        before_slot: Callable[[Rig, int], None] = lambda _rig, _slot: None,
        **plant: float,
    ) -> None:
        told = [f"platform.plant.{key}={value}" for key, value in plant.items()]
        self.rig = Rig(
            *(1.0 / rate, PLATFORM, (*QUICK, *told)),
            attended=False,
            duration=seconds,
            rate=turning,
            lead=lead,
            drives=[self],
            feedback=self,
            corrected=corrected,
            most_off=1.0,
        )
        self._sensed, self._hellos = sensed, 0
        platform = self.rig.scenario.platform
        self._limits = limits_hash(self.rig.wheel_limits, self.rig.stage_limits)
        start = round(1e9 * self.rig.clock.now())
        self.drives = PlantDrives(platform, start)
        self._said: list[bytes] = []
        self.refused = ""
        wait = self.rig.clock.sleep_until

        def sleep_until(time: float) -> None:
            before_slot(self.rig, self.rig.loop.ticks)
            wait(time)

        self.rig.clock.sleep_until = sleep_until  # type: ignore[method-assign]
        self.rig.controller.engage()
        self.rig.loop.run()
        self._go_on(self.rig.tape.sent[-1][2] + 300_000_000)
        self.error = self._errors()

    def send(self, sequence: int, time: float, due: int, state: int, command: Command) -> bool:
        now = round(1e9 * self.rig.clock.now())
        self._go_on(now)
        if sequence % round(1.0 / self.rig.dt) == 1:
            self._hellos += 1
            asked = Hello(self.session, self._hellos, now, self._limits)
            assert self.drives.take(hello.encode(asked), SENDER) == ""
        packet = encode(self.session, sequence, time, due, state, command)
        self.refused = self.refused or self.drives.take(packet, SENDER)
        return True

    def statuses(self) -> Sequence[DriveStatus]:
        self._go_on(round(1e9 * self.rig.clock.now()))
        told = [status.decode(packet)[1] for packet in self._said]
        self._said = []
        return [
            replace(one, sensors=one.sensors and self._sensed(one.number, one.sensors))
            for one in told
        ]

    def _go_on(self, now: int) -> None:
        self._said += [packet for packet, _ in self.drives.go_on(now)]

    def _errors(self) -> np.ndarray:
        """Angle between sphere and schedule at the due times, deg."""
        rows, due = self.drives.rows, [due for _, _, due, _ in self.rig.tape.sent]
        q = np.column_stack([np.interp(due, rows[:, 0], rows[:, 2 + k]) for k in range(4)])
        pairs = zip(q, self.rig.tape.ticks, strict=True)
        return np.degrees([geodesic(tuple(q), tick.motion.q_WS) for q, tick in pairs])

    @property
    def sums(self) -> np.ndarray:
        """Speed and acceleration of the wheels as they were sent (n, 2, 3)."""
        commands = self.rig.tape.commands
        return np.array([(c.wheel_speed, c.wheel_acceleration) for c in commands])


def turned_away(q: Quat, by: Vec3) -> Quat:
    """The orientation turned by a rotation vector (rad) in W."""
    return multiply(exp(by), q)
