"""The duration that a scenario asks for, of any vehicle."""

# mypyc: runs every tick

from math import inf

from ..errors import InputError
from ..signals import Vehicle, VehicleState

_TOLERANCE = 1e-6  # steps; a duration of n dt is n steps however it was rounded


class LimitedDuration:
    """A vehicle whose flight is over after a given time (implements signals.Vehicle)."""

    def __init__(self, vehicle: Vehicle, duration: float) -> None:
        """Limit `vehicle`, which is at its first state, to `duration` s from there.

        Raises InputError for a duration that is not positive and finite.
        """
        if not 0.0 < duration < inf:
            raise InputError(f"duration = {duration} s, must be positive and finite")
        self._vehicle = vehicle
        self._dt: float = vehicle.dt
        self._state: VehicleState = vehicle.state
        self._last: float = self._state.time + duration + _TOLERANCE * self._dt

    @property
    def dt(self) -> float:
        """Time between two states, s."""
        return self._dt

    @property
    def state(self) -> VehicleState:
        """The present state."""
        return self._state

    def advance(self) -> bool:
        """Go one state on; False, and nothing changes, when the next one would be too late.

        The vehicle is not stepped where its next state lies a step ahead. A recording may have a
        gap there. Raises what the vehicle raises.
        """
        if self._state.time + self._dt > self._last or not self._vehicle.advance():
            return False
        state = self._vehicle.state
        if state.time > self._last:
            return False
        self._state = state
        return True
