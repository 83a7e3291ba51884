"""Method `hedge`: keeps with the best of its members, within what its rider may feel."""

from dataclasses import replace
from math import radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing import HedgeParameters
from atlas_cueing.cueing.committee.committee import Committee
from atlas_cueing.rotation import IDENTITY, ZERO, Vec3, angle_between, flip, from_euler, multiply
from atlas_cueing.signals import VehicleState

from .test_perceptual import mirrored
from .vehicles import LEVEL, level_turn, manoeuvring, standing, up_in_cabin, wild
from .wild_rides import CueBound, ride, wild_states

ORGANS, OBSERVER = (
    HedgeParameters(
        replace(
            HedgeParameters().committee, loss=replace(HedgeParameters().committee.loss, judge=judge)
        )
    )
    for judge in ("organs", "observer")
)
BOTH = pytest.mark.parametrize("parameters", [OBSERVER, ORGANS], ids=["observer", "organs"])


def make(dt: float, parameters: HedgeParameters | None = None) -> Committee:
    return (parameters or HedgeParameters()).rotation(dt)


@BOTH
@pytest.mark.parametrize(("bank", "speed"), [(30.0, 150.0), (60.0, 100.0), (-50.0, 50.0)])
def test_a_level_turn_of_any_rate_is_felt_straight_down_the_seat(
    parameters: HedgeParameters, bank: float, speed: float
) -> None:
    dt, errors = 1.0 / 30.0, []
    method = make(dt, parameters)
    for vehicle in level_turn(radians(bank), speed, dt, 1800):
        q_WS, w = method.step(vehicle)
        errors.append(angle_between(up_in_cabin(q_WS), flip(vehicle.f_B)))
    assert errors[0] < 1e-6
    assert max(errors) < radians(12.0)
    assert errors[-1] < radians(0.5)
    assert w[:2] == pytest.approx((0.0, 0.0), abs=radians(0.5))
    assert 0.0 <= -w[2] / vehicle.w_NB_B[2] <= 1.0, "yaw that lasts is not felt: laws may differ"


def test_perceptual_alone_is_trusted_at_the_start() -> None:
    method = make(0.02)
    for vehicle in manoeuvring(0.02, 0.1):
        method.step(vehicle)
    assert method.shares[0] > 0.95


def test_rates_that_no_force_agrees_with_are_left_out() -> None:
    """A vehicle that says it rolls for ever while its force stands: the cabin keeps with it."""
    method = make(0.04)
    for i in range(1500):
        q_WS, w = method.step(VehicleState(i * 0.04, IDENTITY, (3.0, 0.0, 0.0), LEVEL))
    assert angle_between(up_in_cabin(q_WS), (0.0, 0.0, 1.0)) < radians(1.0)
    assert w == pytest.approx(ZERO, abs=radians(1.0))


@BOTH
@given(sequence=wild(490.0, 50.0), dt=st.sampled_from([1.0 / 500.0, 1.0 / 60.0]))
def test_no_more_is_felt_than_the_bound_for_any_vehicle(
    parameters: HedgeParameters, sequence: list[tuple[object, Vec3, Vec3]], dt: float
) -> None:
    """The canals' feeling of what the cabin turns beyond the vehicle's rate."""
    bound = CueBound(parameters, dt)
    for i, (q_NB, w_B, f_B) in enumerate(sequence):
        for _ in range((20, 1, 5, 2)[i % 4]):
            bound.step(VehicleState(0.0, q_NB, w_B, f_B))  # type: ignore[arg-type]
    assert bound.exceeded == 0


@BOTH
def test_to_come_to_the_members_nothing_is_felt_but_what_they_feel(
    parameters: HedgeParameters,
) -> None:
    """With next to no bound of the draw's own, each member counts by its share."""
    own = replace(parameters.committee.turn, felt=1e-6, rate_gain=0.0, error_gain=0.0)
    bound = CueBound(HedgeParameters(replace(parameters.committee, turn=own)), 1.0 / 60.0)
    for vehicle in wild_states(3, 2000, 1.0 / 60.0):
        bound.step(vehicle)
    assert bound.exceeded == 0
    assert bound.fullest > 0.9


@BOTH
def test_a_mirrored_flight_gives_the_mirrored_cue(parameters: HedgeParameters) -> None:
    one, other = make(0.02, parameters), make(0.02, parameters)
    flights = zip(manoeuvring(0.02, 20.0), mirrored(manoeuvring(0.02, 20.0)), strict=True)
    for vehicle, mirror in flights:
        (a, b, c, d), (p, q, r) = one.step(vehicle)
        q_WS, w = other.step(mirror)
        assert q_WS == pytest.approx((a, -b, c, -d), abs=1e-9)
        assert w == pytest.approx((-p, q, -r), abs=1e-9)


@BOTH
def test_the_heading_changes_nothing(parameters: HedgeParameters) -> None:
    one, other, north = make(0.02, parameters), make(0.02, parameters), from_euler(2.0, 0.0, 0.0)
    for vehicle in manoeuvring(0.02, 20.0):
        turned = VehicleState(
            vehicle.time, multiply(north, vehicle.q_NB), vehicle.w_NB_B, vehicle.f_B
        )
        q_WS, w = one.step(vehicle)
        q_turned, w_turned = other.step(turned)
        assert abs(np.dot(q_WS, q_turned)) == pytest.approx(1.0, abs=1e-12)
        assert w_turned == pytest.approx(w, abs=1e-9)


@BOTH
def test_a_quaternion_of_the_other_sign_is_the_same_vehicle(parameters: HedgeParameters) -> None:
    one, other = make(0.02, parameters), make(0.02, parameters)
    for i, vehicle in enumerate(manoeuvring(0.02, 10.0)):
        w, x, y, z = vehicle.q_NB
        q_NB = (-w, -x, -y, -z) if i % 3 == 0 else vehicle.q_NB
        flipped = VehicleState(vehicle.time, q_NB, vehicle.w_NB_B, vehicle.f_B)
        assert other.step(flipped)[1] == pytest.approx(one.step(vehicle)[1], abs=1e-12)


@BOTH
def test_weightless_it_stands_or_turns_as_the_vehicle_does(parameters: HedgeParameters) -> None:
    """There is no force to go by; in the end it is at rest."""
    method = make(1.0 / 20.0, parameters)
    for vehicle in standing(IDENTITY, ZERO, 1.0 / 20.0, 2000):
        q_WS, w = method.step(vehicle)
    assert w == pytest.approx(ZERO, abs=1e-3)
    assert np.linalg.norm(q_WS) == pytest.approx(1.0, abs=1e-12)


@BOTH
def test_wild_rides_keep_every_bound_and_limit(parameters: HedgeParameters) -> None:
    """A short form of `tools/wild_rides`, which rides as long as it is told."""
    found = ride(1, 3000, parameters)
    assert (found.felt_exceeded, found.loss_exceeded, found.violations) == (0, 0, ())
    assert found.fullest > 0.2
    assert found.use > 0.9
