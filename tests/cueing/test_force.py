"""Method `force`: the force's direction at any rate, and with the vehicle about it."""

import json
from collections.abc import Callable, Iterator
from math import cos, pi, radians, sin
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.cueing import ForceParameters
from atlas_cueing.cueing.force import ForceRotation
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
    norm,
    rotate,
    scale,
    to_euler,
)
from atlas_cueing.signals import STANDARD_GRAVITY, VehicleState

from .vehicles import LEVEL, level_turn, standing, up_in_cabin

ROWS = json.loads((Path(__file__).parents[1] / "oracles" / "felt_force.json").read_text())["rows"]
TURNS = [row for row in ROWS if row["case"] == "level coordinated turn"]
ForceAt = Callable[[float], Vec3]


def make(dt: float, parameters: ForceParameters | None = None) -> ForceRotation:
    return ForceRotation(dt, parameters or ForceParameters())


def error(q_WS: Quat, f_B: Vec3) -> float:
    """Angle between what a rider at rest feels and what the vehicle's has."""
    return angle_between(up_in_cabin(q_WS), flip(f_B))


def pushed(force: ForceAt, dt: float, seconds: float, w: Vec3 = ZERO) -> Iterator[VehicleState]:
    """A vehicle whose force is given over time; its attitude is no matter after the start."""
    return (VehicleState(i * dt, IDENTITY, w, force(i * dt)) for i in range(int(seconds / dt)))


@pytest.mark.parametrize("row", TURNS, ids=lambda row: str(row["bank_deg"]))
@pytest.mark.parametrize("speed", [20.0, 250.0])
def test_a_level_turn_of_any_bank_and_rate_is_felt_straight_down_the_seat(
    row: dict[str, object], speed: float
) -> None:
    """Pinned rows; at 20 m/s and 60 deg the turn asks for 42 deg/s of pitch to be left out."""
    dt = 1.0 / 60.0
    method = make(dt)
    for vehicle in level_turn(radians(float(str(row["bank_deg"]))), speed, dt, 1200):
        q_WS, w = method.step(vehicle)
        felt = flip(rotate(conjugate(q_WS), (0.0, 0.0, STANDARD_GRAVITY)))
        assert vehicle.f_B == pytest.approx(row["vehicle_f"], abs=1e-9)
        assert felt == pytest.approx(row["force_aligned_felt"], abs=1e-6)
        assert error(q_WS, vehicle.f_B) < 1e-6
        # body yaw, about W's vertical
        assert w == pytest.approx((0.0, 0.0, -vehicle.w_NB_B[2]), abs=1e-9)


@pytest.mark.parametrize("omega", [0.05, 0.5, 2.0, 5.0])
@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.6, 0.8, 0.0)])
def test_a_turning_force_is_followed_with_no_lag_but_the_filter_s(omega: float, axis: Vec3) -> None:
    """The lag of the filter is 2 atan(omega / bandwidth), and nothing is added to it."""
    dt, b = 1.0 / 240.0, 2.0 * pi
    method, late = make(dt), []
    for vehicle in pushed(lambda t: rotate(exp(scale(omega * t, axis)), LEVEL), dt, 8.0):
        q_WS, w = method.step(vehicle)
        late.append(error(q_WS, vehicle.f_B))
    assert np.mean(late[-100:]) == pytest.approx(2.0 * np.arctan(omega / b), abs=omega * dt + 1e-3)
    assert np.ptp(late[-100:]) < 1e-3
    assert norm(w) == pytest.approx(omega, rel=1e-2)


def test_the_slower_the_force_turns_the_closer_the_cabin_is() -> None:
    """In proportion: the lag is 2 / bandwidth seconds, so that a higher bandwidth is closer too."""
    found = {}
    for b in (2.0 * pi, 4.0 * pi):
        for omega in (0.02, 0.2):
            method = make(0.01, ForceParameters(bandwidth=b))
            for vehicle in pushed(
                lambda t, rate=omega: rotate(exp((rate * t, 0.0, 0.0)), LEVEL), 0.01, 6.0
            ):
                q_WS, _ = method.step(vehicle)
            found[b, omega] = error(q_WS, vehicle.f_B)
            assert found[b, omega] == pytest.approx(2.0 * omega / b, rel=0.05)


@pytest.mark.parametrize("w", [(0.0, 0.0, 0.8), (1.5, 0.0, 0.8), (1.5, -2.0, 0.8), (1.0, 1.0, 0.0)])
def test_the_turn_about_the_force_is_the_body_s_yaw_and_nothing_else(w: Vec3) -> None:
    """Five whole turns and more, none lost.

    Pitch and roll rates without a change of the force's direction do nothing.
    """
    dt, method, turned = 0.01, make(0.01), 0.0
    before = 0.0
    for vehicle in pushed(lambda _: LEVEL, dt, 40.0, w):
        q_WS, w_WS_W = method.step(vehicle)
        heading = to_euler(q_WS)[0]
        turned += (heading - before + pi) % (2.0 * pi) - pi
        before = heading
        assert error(q_WS, LEVEL) < 1e-9
        assert w_WS_W == pytest.approx((0.0, 0.0, -w[2]), abs=1e-9)
    assert turned == pytest.approx(-w[2] * vehicle.time, abs=1e-9)


def test_a_gain_scales_the_turn_about_the_force() -> None:
    method = make(0.01, ForceParameters(rotation_gain=(3.0, 3.0, 0.25)))
    for vehicle in pushed(lambda _: LEVEL, 0.01, 1.0, (0.5, 0.5, 0.8)):
        _, w = method.step(vehicle)
    assert w == pytest.approx((0.0, 0.0, -0.2), abs=1e-9)


@pytest.mark.parametrize("w", [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.4, -0.3, 0.5)])
def test_weightless_it_turns_with_the_vehicle(w: Vec3) -> None:
    """And comes to no harm: nothing is divided by zero force, even where it begins there."""
    dt, method = 0.01, make(0.01)
    for vehicle in pushed(lambda _: ZERO, dt, 5.0, w):
        q_WS, w_WS_W = method.step(vehicle)
        assert rotate(conjugate(q_WS), w_WS_W) == pytest.approx(flip(w), abs=1e-12)


def steady(axis: Vec3) -> ForceAt:
    """Through zero and out on the other side, in two seconds, and on; it is held when reversed."""
    return lambda t: scale(cos(min(0.5 * t, 1.0) * pi) * STANDARD_GRAVITY, axis)


def nearly(axis: Vec3) -> ForceAt:
    """As `steady`, but past zero at 2 m/s^2, where the force is faded in by a third."""
    across = np.cross(axis, (0.36, 0.48, 0.8))
    aside = tuple((2.0 * across / np.linalg.norm(across)).tolist())
    return lambda t: tuple(
        a + sin(min(0.5 * t, 1.0) * pi) * b for a, b in zip(steady(axis)(t), aside, strict=True)
    )


def flipped(axis: Vec3) -> ForceAt:
    """Reversed between two ticks."""
    return lambda t: scale(STANDARD_GRAVITY if t < 1.0 else -STANDARD_GRAVITY, axis)


def gone(axis: Vec3) -> ForceAt:
    """Nothing from the first second to the third, then another direction."""
    return lambda t: (
        scale(STANDARD_GRAVITY, axis) if t < 1.0 else ZERO if t < 3.0 else (3.0, 4.0, -8.0)
    )


AXES: list[Vec3] = [
    (0.0, 0.0, -1.0),
    (1.0, 0.0, 0.0),
    (-1.0, 0.0, 0.0),
    (0.0, 1.0, 0.0),
    (0.6, 0.0, -0.8),
]


@pytest.mark.parametrize("axis", AXES, ids=str)
@pytest.mark.parametrize("path", [steady, nearly, flipped, gone])
def test_reversal_and_weightlessness_are_smooth_and_end_on_the_force(
    path: Callable[[Vec3], ForceAt], axis: Vec3
) -> None:
    """The acceleration is finite: a finer tick does not make it larger."""
    most, turn = [], []
    for dt in (1.0 / 200.0, 1.0 / 800.0):
        method = make(dt)
        states = list(pushed(path(axis), dt, 9.0))
        w = np.array([method.step(vehicle)[1] for vehicle in states])
        assert np.all(np.isfinite(w))
        most.append(np.max(np.linalg.norm(np.diff(w, axis=0), axis=1)) / dt)
        turn.append(np.max(np.linalg.norm(w, axis=1)))
        assert error(method.step(states[-1])[0], states[-1].f_B) < 0.01
        assert np.linalg.norm(w[-1]) < 0.02
    assert turn[0] > 0.5, "it should have turned"
    assert most[1] < 1.5 * most[0]
    assert turn[1] < 1.2 * turn[0]


@pytest.mark.parametrize(
    "f_B", [(0.0, 0.0, STANDARD_GRAVITY), (0.0, 1e-14, 9.8), (-1e-300, 0.0, 3.1)]
)
def test_it_may_begin_upside_down(f_B: Vec3) -> None:
    """A force straight against the vehicle's up at the start.

    Aligned at once, at rest, and it stays so.
    """
    method = make(0.01)
    for vehicle in standing(from_euler(1.0, 0.0, 0.0), f_B, 0.01, 100):
        q_WS, w = method.step(vehicle)
        assert error(q_WS, f_B) < 1e-9
        assert norm(w) < 1e-9
