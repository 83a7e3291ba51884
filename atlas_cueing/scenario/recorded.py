"""Logs as vehicles."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from math import hypot, isfinite
from pathlib import Path
from typing import ClassVar, TypeVar

from ..errors import InputError, LogError
from ..recording import Log, read_log, read_metadata
from ..rotation import Quat, Vec3, continuous
from ..signals import VehicleState
from ..vehicles import Bounds, RecordedVehicle

T = TypeVar("T")
_UNIT = 1e-6  # how far the norm of a quaternion may be from 1; our own logs keep it to 1e-15
# bytes unpacked; an hour at 120 Hz, and about as much again for the states
MAX_RECORDING = 256 * 2**20
# metadata of an imported flight that the logs of its rides have as well
TOLD = ("origin", "map", "attitude", "rate", "force_at", "grid")


@dataclass(frozen=True, slots=True)
class RecordedFlight:
    """The vehicle of the log (MCAP) at `log`, played at its own rate (implements Flight).

    Every log with this program's `/vehicle` will do: one of a run, an imported flight, or one by
    any other writer.
    """

    live_only: ClassVar[str] = ""
    ends_itself: ClassVar[bool] = True

    log: Path

    @property
    def name(self) -> str:
        """Name of the log, without its ending."""
        return self.log.stem

    def vehicle(self) -> RecordedVehicle:
        """Build the vehicle, every state of it checked, from its first state at time 0 on.

        In real time a gap is input that does not come; without a clock `check_regular` refuses it.
        Raises InputError when there is no such log, it is damaged or not one of ours, and as
        `recorded_vehicle`: it is input, and nothing was written.
        """
        try:
            return checked_vehicle(_read(self.log, _within_bounds))
        except (InputError, LogError) as error:
            raise InputError(*(_named(line, self.log) for line in error.lines)) from error

    def length(self) -> float:
        """Return the time from the first state to the last, s. Raises as `vehicle`."""
        return self._measures()[0]

    def step(self) -> float:
        """Return the time between two states, s. Raises as `vehicle`, and for gaps."""
        return self._measures()[1]

    def files(self) -> dict[str, Path]:
        """Return nothing: a log is too large to carry along."""
        return {}

    def large_files(self) -> dict[str, Path]:
        """Return the log, by its name."""
        return {self.log.name: self.log}

    def told(self) -> dict[str, str]:
        """Return where an imported flight is from, and what of it was made and not measured."""
        metadata = _read(self.log, read_metadata)
        return {key: metadata[key] for key in TOLD if metadata.get(key)}

    def _measures(self) -> tuple[float, float]:
        try:
            found = self.log.stat()
        except (OSError, ValueError):
            return _measures(self, 0, 0)
        return _measures(self, found.st_mtime_ns, found.st_size)


def _within_bounds(path: Path) -> Log:
    return read_log(path, MAX_RECORDING)


def _read(path: Path, read: Callable[[Path], T]) -> T:
    """Read of a recording. Raises InputError: it is input, and nothing was written."""
    if not path.is_file():
        raise InputError(f"log {path}: {'not a regular file' if path.exists() else 'no such file'}")
    try:
        return read(path)
    except LogError as error:
        raise InputError(*(_named(line, path) for line in error.lines)) from error


@lru_cache(maxsize=16)  # a sweep asks once for each of its runs
def _measures(flight: RecordedFlight, changed_ns: int, size: int) -> tuple[float, float]:
    """Length and step (s) of a recording as it was when it was last changed."""
    _ = changed_ns, size
    vehicle = flight.vehicle()
    try:
        vehicle.check_regular()
    except InputError as error:
        raise InputError(_named(str(error), flight.log)) from error
    return vehicle.length, vehicle.dt


def recorded_vehicle(log: Log, bounds: Bounds | None = None) -> RecordedVehicle:
    """The vehicle of a log, its states as they are.

    With `bounds` every state must be finite, a rotation, and believable, as if a model had just
    given it; its time then begins at 0, and its quaternions do not jump to the other sign. Raises
    LogError when the log has no vehicle, InputError when it has fewer than two states, or a state
    that is not allowed.
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
    return RecordedVehicle(_from_zero(states) if bounds else states)


def checked_vehicle(log: Log) -> RecordedVehicle:
    """Return the vehicle of a log by any writer, every state checked as `recorded_vehicle` does.

    Raises InputError also when there is no flight in the log.
    """
    found = log.tables.get("/vehicle")
    if found is None:
        raise InputError(
            f"log {log.path}: has no /vehicle, so no flight; topics: {', '.join(log.tables) or '-'}"
        )
    if len(found.values) < 2:
        raise InputError(
            f"log {log.path}: /vehicle has {len(found.values)} states, allowed: at least 2"
        )
    return recorded_vehicle(log, Bounds())


def regular_vehicle(log: Log) -> RecordedVehicle:
    """Return the vehicle as `checked_vehicle` does. Raises InputError for gaps as well."""
    vehicle = checked_vehicle(log)
    try:
        vehicle.check_regular()
    except InputError as error:
        raise InputError(_named(str(error), log.path)) from error
    return vehicle


def _named(line: str, path: Path) -> str:
    return line if str(path) in line else f"log {path}: {line}"


def _state(time: float, q: list[float], w: list[float], f: list[float]) -> VehicleState:
    q_NB: Quat = (q[0], q[1], q[2], q[3])
    w_NB_B: Vec3 = (w[0], w[1], w[2])
    return VehicleState(time, q_NB, w_NB_B, (f[0], f[1], f[2]))


def _from_zero(states: list[VehicleState]) -> list[VehicleState]:
    """Let the time begin at 0 and the quaternions keep their sign; our own logs have both."""
    moved: list[VehicleState] = []
    for state in states:
        q_NB = continuous(state.q_NB, moved[-1].q_NB) if moved else state.q_NB
        time = state.time - states[0].time
        moved.append(VehicleState(time, q_NB, state.w_NB_B, state.f_B))
    return moved


def _check(state: VehicleState, bounds: Bounds, path: Path) -> None:
    norm = hypot(*state.q_NB)
    objection = bounds.objection(state, height=0.0)
    if not abs(norm - 1.0) <= _UNIT:
        objection = f"attitude of norm {norm:.9g}, allowed: 1 within {_UNIT:g}"
    if not isfinite(state.time):
        objection = "time is not finite"
    if objection:
        raise InputError(f"log {path}: vehicle at {state.time:.6g} s: {objection}")
