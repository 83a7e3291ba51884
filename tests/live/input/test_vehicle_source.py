"""Vehicles that own their time, read by a clock of our own."""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from atlas_cueing.errors import VehicleError
from atlas_cueing.live.input.source import Source, SourceReading
from atlas_cueing.live.input.vehicle_source import MAX_STEPS, VehicleSource
from atlas_cueing.rotation import exp, geodesic, multiply
from atlas_cueing.signals import VehicleState
from atlas_cueing.vehicles import (
    AircraftFlight,
    InitialConditions,
    JsbsimVehicle,
    LimitedDuration,
    RecordedVehicle,
    ScriptFlight,
    Signal,
    SignalFlight,
    SignalVehicle,
    own_scripts,
)

from ..motions import Motion, angles, forces, rates, rms

ROLL = SignalFlight(
    (
        Signal("roll_rate", "sine", 1.0, 0.2, 2.5, 0.25, 4.0),
        Signal("force_y", "sine", 2.0, 0.0, 2.0, 0.25, 6.0),
    ),
    120.0,
)


class Counted:
    """A vehicle that counts its steps, endless, with a failure at `fails` (s)."""

    def __init__(self, dt: float = 0.001, fails: float = 1e9) -> None:
        self.dt, self.steps, self._fails = dt, 0, fails

    @property
    def state(self) -> VehicleState:
        return VehicleState(
            self.steps * self.dt, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -9.8)
        )

    def advance(self) -> bool:
        if (self.steps + 1) * self.dt >= self._fails:
            raise VehicleError((self.steps + 1) * self.dt, "broken")
        self.steps += 1
        return True


def reads(
    source: Source, times: list[float], advance: Callable[[float], bool] = lambda _: True
) -> list[SourceReading]:
    return [source.read(t, advance(t)) for t in times]


def vehicles(readings: list[SourceReading]) -> list[VehicleState]:
    found = [reading.vehicle for reading in readings if reading.vehicle is not None]
    assert len(found) == len(readings)
    return found


def ticks(end: float, rate_hz: float = 500.0, start: float = 0.0) -> list[float]:
    return [start + k / rate_hz for k in range(int((end - start) * rate_hz) + 1)]


def test_at_its_own_steps_it_is_the_vehicle_itself() -> None:
    """Read at the model's rate from any first time on: no delay, no error."""
    model, source = SignalVehicle(ROLL), VehicleSource(SignalVehicle(ROLL))
    for k in range(300):
        (got,) = vehicles([source.read(5.0 + k / 120.0, advance=True)])
        assert got.time == 5.0 + k / 120.0
        assert got.f_B == pytest.approx(model.state.f_B, abs=1e-9)
        assert got.w_NB_B == pytest.approx(model.state.w_NB_B, abs=1e-9)
        assert geodesic(got.q_NB, model.state.q_NB) < 1e-9
        model.advance()


@pytest.mark.parametrize("loop_hz", [333.0, 500.0, 1000.0])
def test_between_its_steps_it_is_near_the_truth(loop_hz: float) -> None:
    """Against the same signals flown at the loop's own rate."""
    times = ticks(2.8, loop_hz)
    got = vehicles(reads(VehicleSource(SignalVehicle(ROLL)), times))
    fine = SignalVehicle(replace(ROLL, rate_hz=loop_hz))
    truth = []
    for _ in times:
        truth.append(fine.state)
        fine.advance()
    assert rms(rates(got) - rates(truth)) < 2e-4
    assert float(np.max(angles(got, truth))) < 2e-6
    assert rms(np.diff(rates(got), axis=0) - np.diff(rates(truth), axis=0)) * loop_hz < 0.05


def test_intake_of_a_source_that_is_never_late() -> None:
    for reading in reads(VehicleSource(SignalVehicle(ROLL)), ticks(1.0)):
        assert (
            reading.age,
            reading.dropped,
            reading.bad_in_a_row,
            reading.jumped,
            reading.over,
        ) == (
            0.0,
            0,
            0,
            False,
            False,
        )
        assert reading.reason == ""


def test_paused_it_stands_still_and_goes_on_where_it_was() -> None:
    """Constant attitude and force, no rates, no jump; the pause is not in the vehicle's time."""
    paused = VehicleSource(SignalVehicle(ROLL))
    straight = VehicleSource(SignalVehicle(ROLL))
    readings = reads(paused, ticks(2.0), lambda t: not 0.701 < t < 1.201)
    states = vehicles(readings)
    still = [s for s in states if 0.701 < s.time < 1.201]
    assert len({(s.q_NB, s.f_B, s.w_NB_B) for s in still}) == 1
    assert still[0].w_NB_B == (0.0, 0.0, 0.0)
    assert not any(reading.jumped or reading.over for reading in readings)
    want = vehicles(reads(straight, ticks(1.5)))
    after, expected = [s for s in states if s.time > 1.201], [s for s in want if s.time > 0.701]
    assert forces(after) == pytest.approx(forces(expected), abs=1e-9)
    assert geodesic(states[-1].q_NB, want[-1].q_NB) < 1e-9


def test_over_at_the_end_and_standing_there() -> None:
    source = VehicleSource(LimitedDuration(SignalVehicle(ROLL), 3.0))
    readings = reads(source, ticks(3.5))
    first = next(i for i, reading in enumerate(readings) if reading.over)
    assert first == 1500  # its last state is at 3 s
    assert all(reading.over for reading in readings[first:])
    assert len({(s.q_NB, s.f_B, s.w_NB_B) for s in vehicles(readings[first:])}) == 1
    last = LimitedDuration(SignalVehicle(ROLL), 3.0)
    while last.advance():
        pass
    assert readings[-1].vehicle is not None
    assert geodesic(readings[-1].vehicle.q_NB, last.state.q_NB) < 1e-9
    assert readings[-1].vehicle.w_NB_B == (0.0, 0.0, 0.0)


def test_work_is_bounded_and_a_gap_is_not_made_up_for() -> None:
    vehicle = Counted()
    source = VehicleSource(vehicle)
    source.read(0.0, advance=True)
    before = vehicle.steps
    source.read(10.0, advance=True)
    assert vehicle.steps - before == MAX_STEPS
    source.read(10.002, advance=True)
    assert vehicle.steps - before <= MAX_STEPS + 3


def test_steps_no_further_than_needed() -> None:
    vehicle = Counted(dt=0.01)
    source = VehicleSource(vehicle)
    for t in ticks(0.5):
        source.read(t, advance=True)
        assert vehicle.state.time - 0.01 <= t + 1e-9 < vehicle.state.time + 1e-9


def test_a_failure_passes_through() -> None:
    source = VehicleSource(Counted(fails=0.1))
    reads(source, ticks(0.09))
    with pytest.raises(VehicleError, match="broken"):
        reads(source, ticks(0.2, start=0.092))


def test_a_jump_is_told_once_and_not_turned_through() -> None:
    """JSBSim's own script that trims in mid-run."""
    source = VehicleSource(
        LimitedDuration(JsbsimVehicle(ScriptFlight(own_scripts()["c1722"])), 1.0)
    )
    readings = reads(source, ticks(0.9))
    jumps = [reading for reading in readings if reading.jumped]
    assert len(jumps) == 1
    assert jumps[0].reason.startswith("attitude jumped by")
    q = [state.q_NB for state in vehicles(readings)]
    turns = sorted(geodesic(a, b) for a, b in pairwise(q))
    assert turns[-1] > 0.05
    assert turns[-2] < 0.01


def test_signs_of_the_vehicles_quaternions_make_no_difference() -> None:
    motion = Motion(3.0)
    states = [motion.at(k / 60.0) for k in range(150)]
    flipped = [
        replace(s, q_NB=tuple((-1.0) ** k * c for c in s.q_NB)) for k, s in enumerate(states)
    ]
    got = vehicles(reads(VehicleSource(RecordedVehicle(flipped)), ticks(2.4)))
    want = vehicles(reads(VehicleSource(RecordedVehicle(states)), ticks(2.4)))
    for a, b in zip(got, want, strict=True):
        assert geodesic(a.q_NB, b.q_NB) < 1e-9
        assert (a.w_NB_B, a.f_B) == (b.w_NB_B, b.f_B)


def test_a_recording_is_played_at_its_own_rate_from_its_own_start() -> None:
    motion = Motion(4.0)
    recorded = [motion.at(1.0 + k / 60.0) for k in range(120)]
    got = vehicles(reads(VehicleSource(RecordedVehicle(recorded)), ticks(1.9)))
    truth = [motion.at(1.0 + t) for t in ticks(1.9)]
    assert float(np.max(angles(got, truth))) < 1e-5


def test_a_real_model_is_read_between_its_steps() -> None:
    """JSBSim in level flight: the loop's reads shake no more than the model's own steps do."""
    flight = AircraftFlight("c172x", InitialConditions(1500.0, 55.0, trim=True))
    model = LimitedDuration(JsbsimVehicle(flight), 2.0)
    own = [model.state]
    while model.advance():
        own.append(model.state)
    got = vehicles(reads(VehicleSource(JsbsimVehicle(flight)), ticks(1.9)))
    shake = np.abs(np.diff(rates(got), axis=0)).max() * 500.0
    assert shake <= 1.01 * np.abs(np.diff(rates(own), axis=0)).max() * 120.0 + 1e-9


def test_jumps_back_and_forth_are_each_told() -> None:
    level = VehicleState(0.0, (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, -9.8))
    turned = multiply(level.q_NB, exp((0.0, 0.5, 0.0)))
    states = [
        replace(level, time=0.1 * k, q_NB=turned if k % 4 == 3 else level.q_NB) for k in range(9)
    ]
    readings = reads(VehicleSource(RecordedVehicle(states)), ticks(0.75))
    assert sum(reading.jumped for reading in readings) == 4
    assert {round(abs(s.q_NB[2]), 6) for s in vehicles(readings)} == {0.0, round(abs(turned[2]), 6)}


@pytest.mark.parametrize("loop_hz", [100.0, 120.0, 333.0, 1000.0])
def test_a_step_made_ahead_changes_no_reading(loop_hz: float) -> None:
    """Through a pause, up to the end of the flight and beyond it."""
    alone, prepared = (VehicleSource(LimitedDuration(SignalVehicle(ROLL), 1.5)) for _ in range(2))
    times = ticks(2.5, loop_hz)
    for time, later in pairwise(times):
        advance = not 0.5 < time < 0.8
        assert prepared.read(time, advance) == alone.read(time, advance)
        prepared.prepare(later)
        prepared.prepare(later)


def test_a_step_is_made_ahead_when_the_next_read_needs_it_and_not_before() -> None:
    vehicle = Counted(dt=0.01)
    source = VehicleSource(vehicle)
    source.prepare(0.0)
    assert vehicle.steps == 0  # nothing has been read
    source.read(0.0, advance=True)
    assert vehicle.steps == 1
    source.prepare(0.009)
    assert vehicle.steps == 1
    source.prepare(0.0101)
    assert vehicle.steps == 2
    source.read(0.0101, advance=True)
    assert vehicle.steps == 2


def test_a_failure_ahead_is_raised_by_the_read_that_needs_the_step() -> None:
    source = VehicleSource(Counted(dt=0.01, fails=0.015))
    source.read(0.0, advance=True)
    source.prepare(0.011)
    source.read(0.009, advance=True)  # the good state before it is still there
    with pytest.raises(VehicleError, match="broken"):
        source.read(0.011, advance=True)
