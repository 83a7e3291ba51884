"""A flight kept after it was flown: the same states and the same end, to the last bit."""

from dataclasses import replace
from math import pi

import pytest

from atlas_cueing.errors import VehicleError
from atlas_cueing.signals import Vehicle, VehicleState
from atlas_cueing.vehicles import KeptFlight, RecordedVehicle, RememberedVehicle, flight_of_bytes

REST = VehicleState(0.0, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -9.80665))
# numbers with all their digits, zeros of both signs, and every place of a row different
STATES = [
    replace(
        REST,
        time=0.1 * k,
        q_NB=(0.5, -0.5, 0.5 + k * 1e-17, -0.0),
        w_NB_B=(pi * k, -pi / (k + 1), 5e-324),
        f_B=(0.1 * k, 0.2 * k, -9.80665 * 1.1**k),
    )
    for k in range(20)
]
BYTES_OF_A_STATE = 11 * 8


class Failing(RecordedVehicle):
    """Fails on the way to its tenth state."""

    def __init__(self, error: Exception) -> None:
        super().__init__(STATES)
        self._error = error

    def advance(self) -> bool:
        if self.state == STATES[9]:
            raise self._error
        return super().advance()


def flown(vehicle: Vehicle) -> list[VehicleState]:
    """All states of a flight, whatever ends it."""
    seen = [vehicle.state]
    try:
        while vehicle.advance():
            seen.append(vehicle.state)
    except (VehicleError, ZeroDivisionError):
        pass
    return seen


def kept(vehicle: Vehicle, most: int = 1 << 20) -> KeptFlight | None:
    """The flight as it comes back from a file; None where it is not kept."""
    remembered = RememberedVehicle(vehicle, most)
    assert remembered.dt == vehicle.dt
    flown(remembered)
    flight = remembered.flight()
    return flight and flight_of_bytes(b"".join(flight.parts()))


def test_states_come_back_to_the_last_bit() -> None:
    flight = kept(RecordedVehicle(STATES))
    assert flight
    vehicle = flight.vehicle()
    assert vehicle.dt == RecordedVehicle(STATES).dt
    again = flown(vehicle)
    assert [repr(state) for state in again] == [repr(state) for state in STATES]
    assert (vehicle.advance(), vehicle.state) == (False, STATES[-1])
    assert flown(flight.vehicle()) == STATES  # and once more


def test_a_failure_comes_where_it_came_in_the_flight() -> None:
    flight = kept(Failing(VehicleError(0.95, 'fell "apart"\n\N{DEGREE SIGN}')))
    assert flight
    vehicle = flight.vehicle()
    assert flown(vehicle) == STATES[:10]
    with pytest.raises(VehicleError) as error:
        vehicle.advance()
    assert (error.value.time, error.value.reason) == (0.95, 'fell "apart"\n\N{DEGREE SIGN}')
    assert str(error.value) == str(VehicleError(0.95, 'fell "apart"\n\N{DEGREE SIGN}'))


def test_a_flight_that_did_not_come_to_its_end_is_not_kept() -> None:
    assert kept(Failing(ZeroDivisionError())) is None
    remembered = RememberedVehicle(RecordedVehicle(STATES), 1 << 20)
    for _ in STATES[1:]:
        assert remembered.advance()
        assert remembered.flight() is None  # as when a run is interrupted
    assert not remembered.advance()
    assert remembered.flight()


def test_a_flight_that_takes_too_much_is_forgotten_and_flown_on() -> None:
    assert kept(RecordedVehicle(STATES), len(STATES) * BYTES_OF_A_STATE)
    remembered = RememberedVehicle(RecordedVehicle(STATES), len(STATES) * BYTES_OF_A_STATE - 1)
    assert flown(remembered) == STATES
    assert remembered.flight() is None
