"""Method `blend`: body rates at once, the force's direction soon, no return to neutral."""

import json
from math import e, pi, radians, sin
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.cueing import BlendParameters
from atlas_cueing.cueing.blend import BlendRotation
from atlas_cueing.rotation import (
    IDENTITY,
    Quat,
    Vec3,
    angle_between,
    conjugate,
    exp,
    flip,
    from_euler,
    geodesic,
    norm,
    rotate,
    scale,
    subtract,
)
from atlas_cueing.signals import VehicleState

from .vehicles import LEVEL, level_turn, spinning, standing, up_in_cabin, wild

RATE, SMOOTHING = radians(3.0), 0.25
ROWS = json.loads((Path(__file__).parents[1] / "oracles" / "felt_force.json").read_text())["rows"]
TURNS = [row for row in ROWS if "bank_deg" in row]
OPPOSED: list[Vec3] = [
    tuple(s * float(i == k) for i in range(3)) for k in range(3) for s in (1.0, -1.0)
]  # type: ignore[misc]
Sequence = list[tuple[Quat, Vec3, Vec3]]


def make(dt: float) -> BlendRotation:
    return BlendRotation(dt, BlendParameters())


def error(q_WS: Quat, f_B: Vec3) -> float:
    """Angle between what a rider at rest feels and what the vehicle's has."""
    return angle_between(up_in_cabin(q_WS), flip(f_B))


@pytest.mark.parametrize(
    ("bank", "speed"), [(30.0, 150.0), (60.0, 350.0), (-30.0, 150.0), (15.0, 60.0), (45.0, 200.0)]
)
def test_a_level_turn_is_felt_straight_down_the_seat(bank: float, speed: float) -> None:
    """Where `attitude` is off by the bank, always.

    The pitch rate of the turn stays below what the slow turn takes back.

    It sets in behind its filter, so that at first the cabin pitches with the vehicle, for about
    twice the time constant.
    """
    dt = 1.0 / 60.0
    method, errors = make(dt), []
    for vehicle in level_turn(radians(bank), speed, dt, 3600):
        q_WS, w = method.step(vehicle)
        errors.append(error(q_WS, vehicle.f_B))
    pitch = abs(vehicle.w_NB_B[1])
    assert errors[0] < 1e-6
    assert 0.2 * RATE < pitch < RATE
    # a tick of the turn that is undone: 0.05 deg at the limit and 60 Hz
    assert errors[-1] <= pitch * dt * 1.01
    assert max(errors) == pytest.approx(2.0 * SMOOTHING * pitch, rel=0.3)
    assert w == pytest.approx((0.0, 0.0, -vehicle.w_NB_B[2]), abs=pitch * dt)


@pytest.mark.parametrize("row", TURNS, ids=lambda row: str(row["bank_deg"]))
def test_the_pinned_level_turns(row: dict[str, float]) -> None:
    """At 500 m/s all of them are slow enough.

    The bank of the cabin is nought and its felt force that of the pinned row.
    """
    method = make(0.02)
    for vehicle in level_turn(radians(row["bank_deg"]), 500.0, 0.02, 1500):
        q_WS, _ = method.step(vehicle)
    assert abs(vehicle.w_NB_B[1]) < RATE
    assert vehicle.f_B == pytest.approx(row["vehicle_f"], abs=1e-9)
    assert flip(rotate(conjugate(q_WS), (0.0, 0.0, 9.80665))) == pytest.approx(
        row["force_aligned_felt"], abs=1.01 * 9.81 * RATE * 0.02
    )


def test_a_turn_too_fast_is_undone_at_the_limit_and_no_more() -> None:
    """A turn with 60 deg at 100 m/s pitches with 8.4 deg/s; the cabin makes 5.4 of it."""
    dt, method = 1.0 / 60.0, make(1.0 / 60.0)
    for vehicle in level_turn(radians(60.0), 100.0, dt, 120):
        q_WS, w = method.step(vehicle)
    extra = subtract(rotate(conjugate(q_WS), w), flip(vehicle.w_NB_B))
    assert norm(extra) == pytest.approx(RATE, rel=5e-3)
    assert error(q_WS, vehicle.f_B) == pytest.approx(
        (vehicle.w_NB_B[1] - RATE) * 119.0 * dt + 2.0 * SMOOTHING * RATE, rel=0.1
    )


@pytest.mark.parametrize("rate", [1.0, 3.0, 6.0])
def test_a_fast_roll_passes_one_to_one_but_for_three_degrees_a_second(rate: float) -> None:
    """With the force along the seat, so that all in the slow turn is against it."""
    dt, method = 1.0 / 240.0, make(1.0 / 240.0)
    for i in range(480):
        roll = rate * sin(2.0 * pi * i * dt)
        q_WS, w = method.step(VehicleState(i * dt, IDENTITY, (roll, 0.0, 0.0), LEVEL))
        assert norm(subtract(rotate(conjugate(q_WS), w), (roll, 0.0, 0.0))) <= RATE * (1.0 + 1e-9)
        assert rotate(conjugate(q_WS), w)[0] == pytest.approx(roll, abs=RATE * (1.0 + 1e-9))


@pytest.mark.parametrize("gain", [(1.0, 1.0, 1.0), (0.5, 0.0, 2.0)])
@given(sequence=wild(490.0, 50.0), dt=st.sampled_from([1.0 / 500.0, 1.0 / 60.0]))
def test_the_extra_rate_keeps_its_bounds_for_any_vehicle(
    sequence: Sequence, dt: float, gain: Vec3
) -> None:
    """Rate 3 deg/s, and 2 rate / (e smoothing) of its derivative in cabin axes.

    Less the vehicle's rate times the gain.
    """
    method, before = BlendRotation(dt, BlendParameters(rotation_gain=gain)), None
    for q_NB, w_B, f_B in sequence:
        for _ in range(20):
            q_WS, w = method.step(VehicleState(0.0, q_NB, w_B, f_B))
            own = flip(w_B)
            extra = np.array(rotate(conjugate(q_WS), w)) - (
                gain[0] * own[0],
                gain[1] * own[1],
                gain[2] * own[2],
            )
            assert np.linalg.norm(extra) <= RATE * (1.0 + 1e-9) + 1e-12
            if before is not None:
                assert (
                    np.linalg.norm(extra - before) / dt
                    <= 2.0 * RATE / (e * SMOOTHING) * (1.0 + 1e-6) + 1e-12 / dt
                )
            before = extra


def test_a_turning_force_is_gone_along_with() -> None:
    """The rider is turned with the force at 2 deg/s although the vehicle does not turn.

    The lag is the filter's, and less.
    """
    dt, omega, method = 0.01, radians(2.0), make(0.01)
    for i in range(2000):
        f_B = rotate(exp((omega * i * dt, 0.0, 0.0)), LEVEL)
        q_WS, w = method.step(VehicleState(i * dt, IDENTITY, (0.0, 0.0, 0.0), f_B))
    assert error(q_WS, f_B) < radians(0.05)
    assert norm(w) == pytest.approx(omega, rel=1e-3)


def test_orthogonal_and_reversed_forces_along_every_axis_are_turned_to() -> None:
    """From tail, nose, either side and head: it reaches every direction."""
    dt = 1.0 / 20.0
    for start in OPPOSED:
        method = make(dt)
        for vehicle in standing(IDENTITY, scale(9.8, start), dt, 20):
            method.step(vehicle)
        for vehicle in standing(IDENTITY, scale(-9.8, start), dt, int(80.0 / dt)):
            q_WS, w = method.step(vehicle)
        assert error(q_WS, vehicle.f_B) < 1e-3, start
        assert norm(w) < 1e-3, start


@pytest.mark.parametrize("f_B", [(3.0, 4.0, -9.0), (0.0, 9.0, 1.0), (-12.0, 0.0, 0.1)])
def test_a_lasting_force_is_aligned_with_and_stays_so(f_B: Vec3) -> None:
    dt = 1.0 / 60.0
    method = make(dt)
    method.step(VehicleState(0.0, IDENTITY, (0.0, 0.0, 0.0), LEVEL))
    path = [method.step(v) for v in standing(IDENTITY, f_B, dt, 3000)]
    rates = np.array([w for _, w in path])
    assert np.max(np.linalg.norm(rates, axis=1)) <= RATE * (1.0 + 1e-9)
    jerks = np.linalg.norm(np.diff(rates, axis=0, prepend=np.zeros((1, 3))), axis=1) / dt
    assert np.max(jerks) <= 2.0 * RATE / (np.e * SMOOTHING) * (1.0 + 1e-6)
    assert error(path[-1][0], f_B) < 1e-3
    assert geodesic(IDENTITY, path[-1][0]) == pytest.approx(
        angle_between(flip(f_B), (0.0, 0.0, 1.0)), abs=0.02
    )
    felt = rotate(conjugate(path[-1][0]), (0.0, 0.0, norm(f_B)))
    assert flip(felt) == pytest.approx(f_B, abs=0.02)


def test_nothing_returns_to_neutral() -> None:
    """A climb straight up, the force along the nose.

    The cabin stands on its tail, and stays there.
    """
    dt = 1.0 / 60.0
    method = make(dt)
    for vehicle in spinning(IDENTITY, (0.0, pi / 4.0, 0.0), dt, int(2.0 / dt) + 1):
        method.step(vehicle)
    for vehicle in standing(
        from_euler(0.0, 0.5 * pi, 0.0), (9.80665, 0.0, 0.0), dt, int(120.0 / dt)
    ):
        q_WS, w = method.step(vehicle)
    assert rotate(q_WS, (1.0, 0.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0), abs=1e-6)
    assert norm(w) < 1e-9


def test_the_extra_rate_keeps_its_bounds_for_any_force() -> None:
    """Random forces, flipping, vanishing, with a turning vehicle: cue rate less body rate."""
    random, dt = np.random.default_rng(6), 1.0 / 120.0
    method, extra = make(dt), []
    start = from_euler(0.4, 0.1, 0.2)
    for i, vehicle in enumerate(spinning(start, (0.8, -0.5, 0.3), dt, 6000)):
        if i % 240 == 0:
            f = tuple((10.0 ** random.uniform(-3.0, 3.0) * random.standard_normal(3)).tolist())
        q_WS, w = method.step(VehicleState(vehicle.time, vehicle.q_NB, vehicle.w_NB_B, f))
        extra.append(subtract(rotate(conjugate(q_WS), w), flip(vehicle.w_NB_B)))
    assert np.max(np.linalg.norm(extra, axis=1)) <= RATE * (1.0 + 1e-9)
    assert np.max(np.linalg.norm(extra, axis=1)) > 0.9 * RATE
    turned = np.linalg.norm(np.diff(extra, axis=0), axis=1) / dt
    assert np.max(turned) <= 2.0 * RATE / (np.e * SMOOTHING) * (1.0 + 1e-6)


@pytest.mark.parametrize("size", [0.0, 1e-12, 0.5, 1.499])
def test_the_slow_turn_is_held_near_zero_force(size: float) -> None:
    """For ever, as soon as the filtered force is there.

    Until then it goes along with that for a second at most.
    """
    dt, method = 1.0 / 60.0, make(1.0 / 60.0)
    before, _ = method.step(VehicleState(0.0, IDENTITY, (0.0, 0.0, 0.0), LEVEL))
    states = [method.step(vehicle) for vehicle in standing(IDENTITY, (size, 0.0, 0.0), dt, 900)]
    assert max(geodesic(before, q) for q, _ in states) < RATE * 1.0
    held = [q for q, w in states[-300:] if norm(w) < 1e-9]
    assert len(held) == 300
    assert geodesic(held[0], held[-1]) < 1e-9


@pytest.mark.parametrize("size", [0.0, 1.4])
def test_weightless_it_turns_with_the_vehicle_and_nothing_else(size: float) -> None:
    dt, method = 1.0 / 60.0, make(1.0 / 60.0)
    for vehicle in standing(IDENTITY, (0.0, size, 0.0), dt, 300):
        method.step(VehicleState(vehicle.time, IDENTITY, (0.3, -0.4, 0.5), vehicle.f_B))
    q_WS, w = method.step(VehicleState(5.0, IDENTITY, (0.3, -0.4, 0.5), vehicle.f_B))
    assert rotate(conjugate(q_WS), w) == pytest.approx((0.3, 0.4, -0.5), abs=1e-12)


def test_the_hold_fades_in_between_one_and_two_times() -> None:
    """From standing aligned with a force of that size, it is turned a little aside."""
    dt, rates = 1.0 / 60.0, []
    for size in (1.51, 2.0, 2.5, 2.99, 3.5, 9.0):
        method = make(dt)
        method.step(VehicleState(0.0, IDENTITY, (0.0, 0.0, 0.0), (0.0, 0.0, -size)))
        aside = rotate(exp((0.02, 0.0, 0.0)), (0.0, 0.0, -size))
        rates.append(max(norm(method.step(v)[1]) for v in standing(IDENTITY, aside, dt, 120)))
    assert np.all(np.diff(rates) > -1e-9)
    assert rates[0] < 0.01 * rates[-1]
    assert rates[-2] == pytest.approx(rates[-1])


@pytest.mark.parametrize("f_B", [(0.0, 0.0, 9.80665), (1e-12, 0.0, 9.8), (0.0, -1e-9, 30.0)])
def test_a_reversed_force_is_finite_and_turned_to(f_B: Vec3) -> None:
    dt, method = 1.0 / 30.0, make(1.0 / 30.0)
    method.step(VehicleState(0.0, IDENTITY, (0.0, 0.0, 0.0), LEVEL))
    for vehicle in standing(IDENTITY, f_B, dt, int(75.0 / dt)):
        q_WS, w = method.step(vehicle)
        assert np.all(np.isfinite([*q_WS, *w]))
        assert norm(w) <= RATE * (1.0 + 1e-9)
    assert error(q_WS, f_B) < 1e-3


def test_it_begins_aligned_with_the_force_the_shortest_way() -> None:
    f = (2.0, -3.0, -8.0)
    q_WS, _ = make(0.01).step(VehicleState(0.0, from_euler(2.0, 0.1, 0.2), (0.0, 0.0, 0.0), f))
    assert error(q_WS, f) < 1e-7
    level, _ = make(0.01).step(
        VehicleState(0.0, from_euler(2.0, 0.1, 0.2), (0.0, 0.0, 0.0), (0.1, 0.0, 0.0))
    )
    assert geodesic(level, q_WS) == pytest.approx(error(level, f), abs=1e-9)


def test_body_rates_pass_one_to_one_and_with_a_gain() -> None:
    """In free rotation about a point at rest the force is aligned anyway: when its filter has seen
    it turn for a second or two, the slow turn has nothing to do."""
    dt, w = 1.0 / 120.0, (0.4, -0.3, 0.5)
    method = make(dt)
    for vehicle in spinning(IDENTITY, w, dt, 1200):
        q_WS, w_WS_W = method.step(vehicle)
        extra = subtract(rotate(conjugate(q_WS), w_WS_W), flip(w))
        assert error(q_WS, vehicle.f_B) < RATE * 1.0
        assert norm(extra) < RATE
    assert error(q_WS, vehicle.f_B) < 1e-3
    assert norm(extra) < 1e-3
    half = BlendRotation(dt, BlendParameters(rotation_gain=(0.5, 0.25, 1.0)))
    _, first = half.step(VehicleState(0.0, IDENTITY, w, LEVEL))
    assert first == pytest.approx((0.2, 0.075, -0.5))
    assert scale(1.0, first) == first
