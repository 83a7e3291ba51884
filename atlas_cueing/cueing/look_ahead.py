"""The states of a known flight, some time before they come: look-ahead."""

# mypyc: runs every tick

from collections.abc import Sequence

from ..errors import InputError
from ..signals import VehicleState
from .parameter import Parameter, Range

LOOK_AHEAD = Parameter(
    "look_ahead_s",
    "look_ahead",
    Range(0.0, 5.0),
    "how far ahead the rate that stays with the force is taken from a known flight; above 0 not"
    " live",
    "0: a run and a live flight give the same ride",
)


class LookAhead:
    """Gives, at each state of a flight, the state a fixed time later, and the last one at the end.

    With no time ahead it is the state itself, and no flight has to be known.
    """

    def __init__(self, dt: float, time: float, flight: Sequence[VehicleState]) -> None:
        """Begin before the first state.

        Args:
            dt: tick, s.
            time: how far ahead, s; it is rounded to whole ticks.
            flight: every state of the flight, dt apart; it may be empty for no time.

        Raises InputError for a time ahead without a flight.

        """
        if time > 0.0 and not flight:
            raise InputError(f"look_ahead_s = {time:g} needs the states of the whole flight")
        self._ticks, self._flight, self._now = round(time / dt), flight, 0

    def passed(self) -> Sequence[VehicleState]:
        """Give the states after the first one that look-ahead has passed at the first tick."""
        return self._flight[1 : self._ticks + 1] if self._ticks else ()

    def step(self, vehicle: VehicleState) -> VehicleState:
        """Give the state ahead of the next one, `vehicle`; the first has been taken in before."""
        if self._ticks == 0:
            return vehicle
        self._now += 1
        return self._flight[min(self._now + self._ticks, len(self._flight) - 1)]
