"""Method `perceptual`: rates at first, then the force's direction at any rate of turn."""

from collections.abc import Iterator
from math import inf, radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing import FeltTurnParameters, PerceptualParameters
from atlas_cueing.cueing.perceptual import PerceptualRotation
from atlas_cueing.rotation import (
    IDENTITY,
    ZERO,
    Quat,
    Vec3,
    angle_between,
    conjugate,
    exp,
    flip,
    from_euler,
    multiply,
    norm,
    rotate,
    scale,
    subtract,
)
from atlas_cueing.signals import VehicleState

from .bilinear_canals import Canals
from .test_felt_turn import LAW
from .vehicles import LEVEL, level_turn, manoeuvring, standing, up_in_cabin, wild

Sequence = list[tuple[Quat, Vec3, Vec3]]


def make(dt: float) -> PerceptualRotation:
    return PerceptualRotation(dt, PerceptualParameters())


def error(q_WS: Quat, f_B: Vec3) -> float:
    """Angle between what a rider at rest feels and what the vehicle's has."""
    return angle_between(up_in_cabin(q_WS), flip(f_B))


def extra_rate(cue: tuple[Quat, Vec3], vehicle: Vec3) -> Vec3:
    """Rate of the cue (rad/s, S) less the vehicle's as the cabin has it."""
    return subtract(rotate(conjugate(cue[0]), cue[1]), vehicle)


@pytest.mark.parametrize(("bank", "speed"), [(30.0, 150.0), (60.0, 100.0), (-50.0, 50.0)])
def test_a_level_turn_of_any_rate_is_felt_straight_down_the_seat(bank: float, speed: float) -> None:
    """8.4 and 10.3 deg/s have to be undone: `blend` stays behind for ever."""
    dt = 1.0 / 60.0
    method, errors = make(dt), []
    for vehicle in level_turn(radians(bank), speed, dt, 3600):
        q_WS, w = method.step(vehicle)
        errors.append(error(q_WS, vehicle.f_B))
    assert errors[0] < 1e-6
    assert max(errors) < radians(10.0)
    assert errors[-1] < radians(0.2)
    assert w == pytest.approx((0.0, 0.0, -vehicle.w_NB_B[2]), abs=radians(0.1))


def test_a_turning_force_is_gone_along_with_unfelt() -> None:
    """A force that turns with 1 deg/s beside a vehicle that does not."""
    dt, omega = 0.01, radians(1.0)
    method, canals = make(dt), Canals(dt)
    for i in range(3001):
        f_B = rotate(exp((omega * i * dt, 0.0, 0.0)), LEVEL)
        q_WS, w = method.step(VehicleState(i * dt, IDENTITY, ZERO, f_B))
        felt = canals.feel(rotate(conjugate(q_WS), w))
    assert norm(w) == pytest.approx(omega, abs=radians(0.002))
    assert norm(felt) == pytest.approx(radians(0.0051), abs=radians(0.0003))


def test_a_roll_passes_at_first_and_fades() -> None:
    """0.5 rad/s set in within 0.2 s, with the force along the seat all the time."""
    dt, method, rates = 0.01, make(0.01), []
    for i in range(3001):
        roll = 0.5 * min(i * dt / 0.2, 1.0)
        q_WS, w = method.step(VehicleState(i * dt, IDENTITY, (roll, 0.0, 0.0), LEVEL))
        rates.append(rotate(conjugate(q_WS), w)[0])
    assert 0.8 * 0.5 < max(rates) <= 0.5
    assert abs(rates[-1]) < 0.02
    assert error(q_WS, LEVEL) < radians(1.0)


@pytest.mark.parametrize("gain", [(1.0, 1.0, 1.0), (0.5, 0.0, 2.0)])
@given(sequence=wild(490.0, 50.0), dt=st.sampled_from([1.0 / 500.0, 1.0 / 60.0]))
def test_no_more_is_felt_than_the_bound_for_any_vehicle(
    sequence: Sequence, dt: float, gain: Vec3
) -> None:
    """The canals' feeling of what the cabin turns beyond the vehicle's rate."""
    method = PerceptualRotation(dt, PerceptualParameters(rotation_gain=gain))
    canals, most = Canals(dt), 0.0
    for q_NB, w_B, f_B in sequence:
        x, y, z = flip(w_B)
        own = (gain[0] * x, gain[1] * y, gain[2] * z)
        most = max(most, LAW.felt + LAW.rate_gain * norm(own) + LAW.error_gain * np.pi)
        for _ in range(20):
            cue = method.step(VehicleState(0.0, q_NB, w_B, f_B))
            felt = canals.feel(extra_rate(cue, own))
            assert norm(felt) <= min(most, LAW.extra) * (1.0 + 1e-9) + 1e-11


@given(sequence=wild(490.0, 50.0))
def test_endless_canals_bound_the_extra_rate_itself(sequence: Sequence) -> None:
    turn = FeltTurnParameters(canals=inf, rate_gain=0.0, error_gain=0.0)
    method = PerceptualRotation(0.01, PerceptualParameters(turn=turn))
    for q_NB, w_B, f_B in sequence:
        for _ in range(20):
            cue = method.step(VehicleState(0.0, q_NB, w_B, f_B))
            assert norm(extra_rate(cue, flip(w_B))) <= turn.felt * (1.0 + 1e-9) + 1e-11


def mirrored(flight: Iterator[VehicleState]) -> Iterator[VehicleState]:
    """The same flight with left and right exchanged."""
    for vehicle in flight:
        (w, x, y, z), (p, q, r), (fx, fy, fz) = vehicle.q_NB, vehicle.w_NB_B, vehicle.f_B
        yield VehicleState(vehicle.time, (w, -x, y, -z), (-p, q, -r), (fx, -fy, fz))


def test_a_mirrored_flight_gives_the_mirrored_cue() -> None:
    one, other = make(0.02), make(0.02)
    flights = zip(manoeuvring(0.02, 20.0), mirrored(manoeuvring(0.02, 20.0)), strict=True)
    for vehicle, mirror in flights:
        (a, b, c, d), (p, q, r) = one.step(vehicle)
        q_WS, w = other.step(mirror)
        assert q_WS == pytest.approx((a, -b, c, -d), abs=1e-9)
        assert w == pytest.approx((-p, q, -r), abs=1e-9)


def test_the_heading_changes_nothing() -> None:
    one, other, north = make(0.02), make(0.02), from_euler(2.0, 0.0, 0.0)
    for vehicle in manoeuvring(0.02, 20.0):
        turned = VehicleState(
            vehicle.time, multiply(north, vehicle.q_NB), vehicle.w_NB_B, vehicle.f_B
        )
        q_WS, w = one.step(vehicle)
        q_turned, w_turned = other.step(turned)
        assert abs(np.dot(q_WS, q_turned)) == pytest.approx(1.0, abs=1e-12)
        assert w_turned == pytest.approx(w, abs=1e-9)


def test_orthogonal_and_reversed_forces_along_every_axis_are_turned_to() -> None:
    dt = 0.05
    for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
        for sign in (9.8, -9.8):
            method = make(dt)
            method.step(VehicleState(0.0, IDENTITY, ZERO, scale(-sign, axis)))
            for vehicle in standing(IDENTITY, scale(sign, axis), dt, 1200):
                q_WS, w = method.step(vehicle)
            assert error(q_WS, vehicle.f_B) < 1e-2, axis
            assert norm(w) < 1e-2, axis


def test_weightless_what_is_left_of_the_extra_rate_is_given_up() -> None:
    """And with it the rider turns with the vehicle alone."""
    dt, method = 1.0 / 60.0, make(1.0 / 60.0)
    for vehicle in standing(IDENTITY, ZERO, dt, 6000):
        cue = method.step(VehicleState(vehicle.time, IDENTITY, (0.3, -0.4, 0.5), ZERO))
    assert extra_rate(cue, (0.3, 0.4, -0.5)) == pytest.approx(ZERO, abs=1e-4)
