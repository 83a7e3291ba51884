"""Logs as vehicles."""

from dataclasses import dataclass
from math import hypot, isfinite
from pathlib import Path
from typing import ClassVar

from ..errors import InputError
from ..recording import Log, read_log
from ..rotation import Quat, Vec3
from ..signals import VehicleState
from ..vehicles import Bounds, RecordedVehicle

_UNIT = 1e-6  # how far the norm of a quaternion may be from 1; our own logs keep it to 1e-15
# bytes unpacked; an hour at 120 Hz, and about as much again for the states
MAX_RECORDING = 256 * 2**20


@dataclass(frozen=True, slots=True)
class RecordedFlight:
    """The vehicle of the log (MCAP) at `log`, played at its own rate (implements Flight)."""

    live_only: ClassVar[str] = (
        "source = 'recording' flies only live: atlas-cueing live FILE; without a clock:"
        " atlas-cueing recue LOG"
    )
    ends_itself: ClassVar[bool] = True

    log: Path

    @property
    def name(self) -> str:
        """Name of the log, without its ending."""
        return self.log.stem

    def vehicle(self) -> RecordedVehicle:
        """Build the vehicle, every state of it checked.

        Raises InputError when there is no such log, and as `recorded_vehicle`.
        """
        if not self.log.is_file():
            raise InputError(
                f"log {self.log}: {'not a regular file' if self.log.exists() else 'no such file'}"
            )
        return recorded_vehicle(read_log(self.log, MAX_RECORDING), Bounds())

    def length(self) -> float:
        """Return the time from the first state to the last, s. Raises as `vehicle`."""
        return self.vehicle().length

    def step(self) -> float:
        """Return the time between two states, s. Raises as `vehicle`."""
        return self.vehicle().dt

    def files(self) -> dict[str, Path]:
        """Return nothing: a log is too large to carry along."""
        return {}

    def large_files(self) -> dict[str, Path]:
        """Return the log, by its name."""
        return {self.log.name: self.log}


def recorded_vehicle(log: Log, bounds: Bounds | None = None) -> RecordedVehicle:
    """The vehicle of a log, its states as they are.

    With `bounds` every state must be finite, a rotation, and believable, as if a model had just
    given it. Raises LogError when the log has no vehicle, InputError when it has fewer than two
    states, or a state that is not allowed.
    """
    columns = (
        log.column("/vehicle", "time_s"),
        log.vector("/vehicle", "q_nb"),
        log.vector("/vehicle", "w"),
        log.vector("/vehicle", "f"),
    )
    states = [_state(*row) for row in zip(*(column.tolist() for column in columns), strict=True)]
    for state in states if bounds else ():
        _check(state, bounds or Bounds(), log.path)
    return RecordedVehicle(states)


def _state(time: float, q: list[float], w: list[float], f: list[float]) -> VehicleState:
    q_NB: Quat = (q[0], q[1], q[2], q[3])
    w_NB_B: Vec3 = (w[0], w[1], w[2])
    return VehicleState(time, q_NB, w_NB_B, (f[0], f[1], f[2]))


def _check(state: VehicleState, bounds: Bounds, path: Path) -> None:
    norm = hypot(*state.q_NB)
    objection = bounds.objection(state, height=0.0)
    if not abs(norm - 1.0) <= _UNIT:
        objection = f"attitude of norm {norm:.9g}, allowed: 1 within {_UNIT:g}"
    if not isfinite(state.time):
        objection = "time is not finite"
    if objection:
        raise InputError(f"log {path}: vehicle at {state.time:.6g} s: {objection}")
