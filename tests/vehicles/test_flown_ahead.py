"""A flight known before it is used."""

from dataclasses import replace

import pytest

from atlas_cueing.errors import InputError, VehicleError
from atlas_cueing.signals import Vehicle, VehicleState
from atlas_cueing.vehicles import FlownAhead, RecordedVehicle

REST = VehicleState(0.0, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -9.80665))
STATES = [replace(REST, time=0.1 * k) for k in range(20)]


class Failing(RecordedVehicle):
    """Fails on the way to its tenth state, or with an error that nobody expects."""

    def __init__(self, error: Exception) -> None:
        super().__init__(STATES)
        self._error = error

    def advance(self) -> bool:
        if self.state == STATES[9]:
            raise self._error
        return super().advance()


def test_states_come_in_order_and_are_all_known_at_once() -> None:
    vehicle: Vehicle = FlownAhead(RecordedVehicle(STATES))
    assert isinstance(vehicle, FlownAhead)
    assert (vehicle.dt, vehicle.states) == (STATES[1].time, STATES)
    seen = [vehicle.state]
    while vehicle.advance():
        seen.append(vehicle.state)
    assert seen == STATES
    assert (vehicle.advance(), vehicle.state) == (False, STATES[-1])


def test_a_failure_comes_where_it_came_in_the_flight() -> None:
    vehicle = FlownAhead(Failing(VehicleError(0.95, "fell apart")))
    assert vehicle.states == STATES[:10]
    assert all(vehicle.advance() for _ in range(9))
    for _ in range(2):
        with pytest.raises(VehicleError, match="fell apart"):
            vehicle.advance()
    assert vehicle.state == STATES[9]


def test_an_error_that_nobody_expects_comes_at_once() -> None:
    with pytest.raises(ZeroDivisionError):
        FlownAhead(Failing(ZeroDivisionError()))


def test_a_flight_that_would_fill_the_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("atlas_cueing.vehicles.flown_ahead.MOST_STATES", len(STATES))
    assert FlownAhead(RecordedVehicle(STATES)).states == STATES
    monkeypatch.setattr("atlas_cueing.vehicles.flown_ahead.MOST_STATES", len(STATES) - 1)
    with pytest.raises(InputError, match="allowed: states <= 19; set duration_s"):
        FlownAhead(RecordedVehicle(STATES))
