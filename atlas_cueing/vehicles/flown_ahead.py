"""A flight known before it is used."""

from ..errors import InputError, VehicleError
from ..signals import Vehicle, VehicleState

MOST_STATES = 1_000_000  # 0.5 GB; two hours at 120 Hz


class FlownAhead:
    """Flies a vehicle to its end when made, and then plays its states back.

    It implements `signals.Vehicle`.

    For cueing that has to know the whole flight before the first tick. A failure of the vehicle
    comes where it came in the
    flight: after the states before it.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        """Take about 0.5 kB for each state.

        Raises InputError for a flight of more than MOST_STATES.
        """
        self.dt = vehicle.dt
        self.states = [vehicle.state]
        self._failure: VehicleError | None = None
        self._now = 0
        try:
            while vehicle.advance():
                self.states.append(vehicle.state)
                if len(self.states) > MOST_STATES:
                    raise InputError(
                        f"the whole flight is kept in memory, allowed: states <= {MOST_STATES}; set"
                        " duration_s"
                    )
        except VehicleError as error:
            self._failure = error

    @property
    def state(self) -> VehicleState:
        """The present state."""
        return self.states[self._now]

    def advance(self) -> bool:
        """Go one state on; False, and nothing changes, after the last one.

        Raises VehicleError where the vehicle did.
        """
        if self._now + 1 < len(self.states):
            self._now += 1
            return True
        if self._failure:
            raise self._failure
        return False
