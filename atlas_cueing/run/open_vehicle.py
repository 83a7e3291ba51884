"""The vehicle that a scenario asks for, whatever its source."""

from ..errors import InputError
from ..scenario import Scenario
from ..signals import Vehicle
from ..vehicles import Flight, LimitedDuration, RecordedVehicle


def open_vehicle(scenario: Scenario, *, live: bool = False) -> Vehicle:
    """Build the vehicle of `scenario`, which ends after the scenario's duration.

    live: whether it flies in real time, as some sources only do.

    Raises InputError for what cannot fly or flies only live and for a recording with gaps without
    a clock or that is damaged, and VehicleError for a model that fails in its first state.
    """
    flight = scenario.live_flight if live else scenario.flight
    asked = scenario.file.duration_s
    end = asked if asked is not None or flight.ends_itself else flight.length()
    if end is None and not flight.ends_itself:
        raise InputError(
            f"the flight of {flight.name!r} has no end of its own; allowed: with duration_s"
        )
    with scenario.naming_file():
        vehicle = flight.vehicle()
    if isinstance(vehicle, RecordedVehicle) and not live:
        _check_regular(vehicle, flight)
    return vehicle if end is None else LimitedDuration(vehicle, end)


def _check_regular(vehicle: RecordedVehicle, flight: Flight) -> None:
    try:
        vehicle.check_regular()
    except InputError as error:
        raise InputError(f"log {flight.name}: {error}") from error


def flight_length(flight: Flight, asked: float | None) -> float | None:
    """Return how long a flight is at most, s, as far as it is known beforehand.

    asked: the scenario's duration, s; None without.
    """
    own = flight.length() if flight.ends_itself or asked is None else None
    return min((time for time in (own, asked) if time is not None), default=None)
