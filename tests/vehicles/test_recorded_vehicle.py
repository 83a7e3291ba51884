"""Recorded states played back."""

from dataclasses import replace

import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.signals import Vehicle, VehicleState
from atlas_cueing.vehicles import RecordedVehicle

REST = VehicleState(0.0, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -9.80665))


def states(count: int, dt: float) -> list[VehicleState]:
    """A vehicle that rolls faster and faster."""
    return [replace(REST, time=k * dt, w_NB_B=(0.1 * k, 0.0, 0.0)) for k in range(count)]


@pytest.mark.parametrize("dt", [0.0083333, 1.0 / 120.0, 0.002, 0.1])
def test_states_come_back_as_they_were(dt: float) -> None:
    flown = states(1000, dt)
    vehicle: Vehicle = RecordedVehicle(flown)
    assert vehicle.dt == dt
    seen = [vehicle.state]
    while vehicle.advance():
        seen.append(vehicle.state)
    assert seen == flown


def test_the_end_stays_the_end() -> None:
    vehicle = RecordedVehicle(states(3, 0.1))
    assert [vehicle.advance() for _ in range(4)] == [True, True, False, False]
    assert vehicle.state == states(3, 0.1)[2]


@pytest.mark.parametrize("count", [0, 1])
def test_too_few_states(count: int) -> None:
    with pytest.raises(InputError, match=f"this one has {count}"):
        RecordedVehicle(states(count, 0.1))


@pytest.mark.parametrize("time", [0.1, 0.0, float("nan")])
def test_time_must_go_on(time: float) -> None:
    flown = states(3, 0.1)
    with pytest.raises(InputError, match=r"after 0\.1 s"):
        RecordedVehicle([*flown[:2], replace(flown[2], time=time)])
