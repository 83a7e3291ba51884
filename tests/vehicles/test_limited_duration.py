"""The duration of a flight, whatever the vehicle."""

from dataclasses import replace
from math import inf, nan

import pytest

from atlas_cueing.errors import InputError, VehicleError
from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles import JsbsimVehicle, LimitedDuration, RecordedVehicle

from .flying import cessna, fly

REST = VehicleState(0.0, IDENTITY, ZERO, (0.0, 0.0, -9.80665))


class Endless:
    """A vehicle at rest that counts its steps, and fails at `fails` s."""

    def __init__(self, dt: float, begin: float = 0.0, fails: float = inf) -> None:
        self.dt, self.steps, self._begin, self._fails = dt, 0, begin, fails

    @property
    def state(self) -> VehicleState:
        return replace(REST, time=self._begin + self.steps * self.dt)

    def advance(self) -> bool:
        if self._begin + (self.steps + 1) * self.dt >= self._fails:
            raise VehicleError(self._fails, "over")
        self.steps += 1
        return True


@pytest.mark.parametrize(
    ("dt", "duration", "steps"),
    [
        (0.01, 0.29, 29),  # 0.29 / 0.01 is less than 29
        (0.1, 0.7, 7),  # and 0.7 / 0.1 less than 7
        (0.1, 0.3, 3),
        (0.1, 0.39, 3),
        (1 / 120, 0.5, 60),
        (1 / 120, 0.504, 60),
        (0.001, 3600.0, 3_600_000),
    ],
)
@pytest.mark.parametrize("begin", [0.0, 17.3])
def test_it_ends_at_the_last_step_inside(
    dt: float, duration: float, steps: int, begin: float
) -> None:
    vehicle = Endless(dt, begin)
    vehicle.steps = skipped = max(steps - 100, 0)
    limited = LimitedDuration(Endless(dt, begin), duration)
    limited._vehicle, limited._state = vehicle, vehicle.state
    while limited.advance():
        pass
    assert vehicle.steps == steps > skipped
    assert limited.state == vehicle.state
    assert not limited.advance()
    assert vehicle.steps == steps, "it was stepped once more"


def test_a_vehicle_that_ends_before_ends_the_flight() -> None:
    recorded = RecordedVehicle([replace(REST, time=0.1 * k) for k in range(5)])
    assert len(fly(LimitedDuration(recorded, 3.0))) == 5


def test_a_gap_of_a_recording_is_not_flown_across_the_end() -> None:
    times = (0.0, 0.1, 0.2, 0.9, 1.0)
    recorded = RecordedVehicle([replace(REST, time=time) for time in times])
    limited = LimitedDuration(recorded, 0.5)
    assert [state.time for state in fly(limited)] == [0.0, 0.1, 0.2]
    assert not limited.advance()
    assert limited.state.time == 0.2


def test_a_failure_after_the_end_is_not_met() -> None:
    limited = LimitedDuration(Endless(0.1, fails=0.6), 0.5)
    assert len(fly(limited)) == 6
    with pytest.raises(VehicleError):
        fly(LimitedDuration(Endless(0.1, fails=0.6), 0.7))


def test_a_model_is_cut_as_any_other() -> None:
    assert fly(JsbsimVehicle(cessna()), 0.504)[-1].time == 60 * (1.0 / 120.0)


@pytest.mark.parametrize("duration", [0.0, -1.0, nan, inf])
def test_a_duration_that_is_none_is_refused(duration: float) -> None:
    with pytest.raises(InputError, match="must be positive and finite"):
        LimitedDuration(Endless(0.1), duration)
