"""A flight kept after it was flown, to be ridden again without its model.

What a vehicle does depends on nothing that rides it, so a sweep over methods, gains and platforms
needs each flight once. The states come back as they were, to the last bit.
"""

# mypyc: runs every tick

import json
import sys
from array import array
from collections.abc import Iterator
from struct import Struct, iter_unpack

from ..errors import VehicleError
from ..signals import Vehicle, VehicleState

_ROW = "<11d"  # time, q_NB, w_NB_B, f_B
_HEAD = Struct("<I")  # bytes of what comes first: the step, and the failure at the end, as JSON
_NUMBERS = 11


class KeptFlight:
    """The states of a whole flight, and how it ended.

    dt: time between two states, s. rows: 11 doubles for each state, little-endian: time (s), q_NB,
    w_NB_B (rad/s), f_B (m/s^2). failure: time (s) and reason of the VehicleError that ended it;
    None when it came to its end.
    """

    def __init__(self, dt: float, rows: bytes, failure: tuple[float, str] | None = None) -> None:
        """Keep `rows`, of one state at least."""
        self.dt = dt
        self.rows = rows
        self.failure = failure

    def parts(self) -> tuple[bytes, bytes]:
        """Return it as a file's content, in two parts."""
        head = json.dumps({"dt": self.dt.hex(), "failure": self.failure}).encode()
        return _HEAD.pack(len(head)) + head, self.rows

    def vehicle(self) -> "ReplayedVehicle":
        """Return a vehicle at the first state, which does all as it was done."""
        return ReplayedVehicle(self)


def flight_of_bytes(content: bytes) -> KeptFlight:
    """Return the flight whose parts these are, one after the other."""
    size: int = _HEAD.unpack_from(content)[0]
    begin = _HEAD.size
    head = json.loads(content[begin : begin + size])
    failure = head["failure"]
    return KeptFlight(
        float.fromhex(head["dt"]),
        content[begin + size :],
        None if failure is None else (float(failure[0]), str(failure[1])),
    )


class RememberedVehicle:
    """A vehicle whose states are written down while it flies (implements signals.Vehicle)."""

    def __init__(self, vehicle: Vehicle, most_bytes: int) -> None:
        """Follow `vehicle`, which is at its first state.

        most_bytes: a flight that takes more, 88 for each state, is forgotten as soon as it does.
        """
        self._vehicle = vehicle
        self._state: VehicleState = vehicle.state
        self._rows = array("d")
        self._most: int = most_bytes // 8
        self._ended = False
        self._failure: tuple[float, str] | None = None
        self._write()

    @property
    def dt(self) -> float:
        """Time between two states, s."""
        return self._vehicle.dt

    @property
    def state(self) -> VehicleState:
        """The present state."""
        return self._state

    def advance(self) -> bool:
        """Go one state on; False, and nothing changes, after the last one.

        Raises what the vehicle raises.
        """
        try:
            went = self._vehicle.advance()
        except VehicleError as error:
            self._ended, self._failure = True, (error.time, error.reason)
            raise
        if went:
            self._state = self._vehicle.state
            self._write()
        else:
            self._ended = True
        return went

    def flight(self) -> KeptFlight | None:
        """Return the flight; None when it is not over, or was too long to be kept."""
        if not self._ended or self._most == 0:
            return None
        return KeptFlight(self.dt, _little_endian(self._rows), self._failure)

    def _write(self) -> None:
        state, rows = self._state, self._rows
        if len(rows) + _NUMBERS > self._most:
            self._rows, self._most = array("d"), 0
            return
        rows.append(state.time)
        rows.extend(state.q_NB)
        rows.extend(state.w_NB_B)
        rows.extend(state.f_B)


class ReplayedVehicle:
    """A kept flight as a vehicle (implements signals.Vehicle)."""

    def __init__(self, flight: KeptFlight) -> None:
        """Begin at the first state."""
        self._dt = flight.dt
        self._failure = flight.failure
        self._rows: Iterator[tuple[float, ...]] = iter_unpack(_ROW, flight.rows)
        self._state: VehicleState = _state(next(self._rows))

    @property
    def dt(self) -> float:
        """Time between two states, s."""
        return self._dt

    @property
    def state(self) -> VehicleState:
        """The present state."""
        return self._state

    def advance(self) -> bool:
        """Go one state on; False, and nothing changes, after the last one.

        Raises VehicleError where the vehicle did.
        """
        row = next(self._rows, None)
        if row is not None:
            self._state = _state(row)
            return True
        if self._failure is not None:
            raise VehicleError(self._failure[0], self._failure[1])
        return False


def _state(row: tuple[float, ...]) -> VehicleState:
    time, qw, qx, qy, qz, wx, wy, wz, fx, fy, fz = row
    return VehicleState(time, (qw, qx, qy, qz), (wx, wy, wz), (fx, fy, fz))


def _little_endian(rows: "array[float]") -> bytes:
    if sys.byteorder == "big":
        rows.byteswap()
    return rows.tobytes()
