"""Method `attitude` against scipy: one to one for ever, heading taken off, jumps never chased."""

import json
from math import pi, radians
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.cueing import AttitudeParameters
from atlas_cueing.cueing.attitude import AttitudeRotation
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
    multiply,
    norm,
    rotate,
    scale,
)
from atlas_cueing.signals import STANDARD_GRAVITY, VehicleState

from .vehicles import LEVEL, level_turn, spinning, standing

D = np.diag([1.0, -1.0, -1.0])
ROWS = json.loads((Path(__file__).parents[1] / "oracles" / "felt_force.json").read_text())["rows"]
TURNS = [row for row in ROWS if "bank_deg" in row]
AT_REST = [row for row in ROWS if "theta_deg" in row]


def felt(q_WS: Quat) -> Vec3:
    """What a rider at rest feels, FRD."""
    return flip(rotate(conjugate(q_WS), (0.0, 0.0, STANDARD_GRAVITY)))


def expected(q_NB: Quat, heading: float) -> Rotation:
    """q_WS by matrices: FLU axes on both sides, N turned so that x points along the heading."""
    level = Rotation.from_euler("z", heading).as_matrix().T
    return Rotation.from_matrix(D @ level @ Rotation.from_quat(np.roll(q_NB, -1)).as_matrix() @ D)


def off(q_WS: Quat, truth: Rotation) -> float:
    return float((Rotation.from_quat(np.roll(q_WS, -1)).inv() * truth).magnitude())


@pytest.mark.parametrize("heading", [0.0, 1.0, -2.5, pi])
def test_heading_is_removed_at_the_start_and_nothing_else(heading: float) -> None:
    q = from_euler(heading, 0.3, -0.7)
    q_WS, w = AttitudeRotation(0.01, AttitudeParameters()).step(
        VehicleState(0.0, q, (0.0, 0.0, 0.0), LEVEL)
    )
    assert off(q_WS, expected(q, heading)) < 1e-9
    assert w == (0.0, 0.0, 0.0)


def test_body_rates_are_turned_into_the_base_frame() -> None:
    """Upside down, a yaw to the right is a turn to the left in W, about +z."""
    vehicle = VehicleState(0.0, from_euler(0.0, 0.0, pi), (0.1, 0.0, 0.4), (0.0, 0.0, 9.8))
    _, w = AttitudeRotation(0.01, AttitudeParameters()).step(vehicle)
    assert w == pytest.approx((0.1, 0.0, 0.4), abs=1e-12)
    upright = VehicleState(0.0, IDENTITY, (0.1, 0.2, 0.4), LEVEL)
    assert AttitudeRotation(0.01, AttitudeParameters()).step(upright)[1] == pytest.approx(
        (0.1, -0.2, -0.4)
    )


def test_a_thousand_turns_about_a_tilted_axis() -> None:
    """On the attitude all the way, not a tick late; the slow turn has nothing to take back."""
    dt, n, w = 1.0 / 20.0, 40_000, (2.0, -1.5, 2.2)
    start = from_euler(0.8, 0.3, -0.4)
    method, last, worst = AttitudeRotation(dt, AttitudeParameters()), start, 0.0
    for i, vehicle in enumerate(spinning(start, w, dt, n)):
        q_WS, w_WS_W = method.step(vehicle)
        if i % 50 == 0:
            truth = expected(vehicle.q_NB, 0.8)
            worst = max(worst, off(q_WS, truth))
            assert np.linalg.norm(truth.inv().apply(w_WS_W) - D @ w) < 1e-6
        last = vehicle.q_NB
    assert norm(w) * dt * n > 1000.0 * 2.0 * pi
    assert worst < 1e-6
    for vehicle in standing(last, LEVEL, dt, 300):
        q_WS, w_WS_W = method.step(vehicle)
    assert off(q_WS, expected(last, 0.8)) < 1e-5
    assert norm(w_WS_W) < 1e-6
    assert sum(x * x for x in q_WS) == pytest.approx(1.0, abs=1e-14)


def test_the_orientation_and_the_rate_are_one_motion() -> None:
    """Finite differences of q_WS give w_WS_W, in the base frame."""
    dt, method = 1e-3, AttitudeRotation(1e-3, AttitudeParameters())
    cues = [method.step(v) for v in spinning(from_euler(0.2, 0.5, 1.0), (1.0, 0.5, -2.0), dt, 500)]
    q = Rotation.from_quat(np.roll([c[0] for c in cues], -1, axis=1))
    made = (q[2:] * q[:-2].inv()).as_rotvec() / (2.0 * dt)
    assert np.max(np.abs(made - np.array([c[1] for c in cues])[1:-1])) < 1e-4


@pytest.mark.parametrize("jump", [0.2, 1.5, 3.1, pi])
def test_a_jump_is_not_chased_and_taken_back(jump: float) -> None:
    dt, method = 1.0 / 60.0, AttitudeRotation(1.0 / 60.0, AttitudeParameters())
    q1 = exp(scale(jump / 3.0, (2.0, -1.0, 2.0)))
    for vehicle in standing(IDENTITY, LEVEL, dt, 30):
        before = method.step(vehicle)[0]
    path = [
        method.step(vehicle)
        for vehicle in standing(q1, LEVEL, dt, int((jump / radians(3.0) + 10.0) / dt))
    ]
    steps = [
        geodesic(a, b)
        for a, b in zip([before, *(q for q, _ in path)], [q for q, _ in path], strict=False)
    ]
    assert max(steps) <= radians(3.0) * dt * (1.0 + 1e-9)
    assert max(norm(w) for _, w in path) <= radians(3.0) * (1.0 + 1e-9)
    assert max(norm(w) for _, w in path) > radians(2.99)
    w = np.array([w for _, w in path])
    assert np.max(np.linalg.norm(np.diff(w, axis=0), axis=1)) / dt <= 2.0 * radians(3.0) / (
        np.e * 0.25
    ) * (1.0 + 1e-6)
    assert off(path[-1][0], expected(q1, 0.0)) < 1e-3


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)])
def test_a_gain_of_a_half_halves_the_turn(axis: Vec3) -> None:
    dt, rate = 1.0 / 100.0, 0.5
    method = AttitudeRotation(dt, AttitudeParameters(rotation_gain=(0.5, 0.5, 0.5)))
    for vehicle in spinning(IDENTITY, scale(rate, axis), dt, 201):
        q_WS, w = method.step(vehicle)
    assert norm(w) == pytest.approx(0.5 * rate, rel=1e-6)
    for vehicle in standing(exp(scale(2.0 * rate, axis)), LEVEL, dt, 1500):
        q_WS, w = method.step(vehicle)
    assert off(q_WS, expected(exp(scale(1.0 * rate, axis)), 0.0)) < 1e-6


def test_gains_work_cabin_axis_by_cabin_axis() -> None:
    dt, method = 0.01, AttitudeRotation(0.01, AttitudeParameters(rotation_gain=(1.0, 0.0, 0.5)))
    path = [exp((0.01 * i, 0.0, 0.0)) for i in range(101)]
    path += [multiply(path[-1], exp((0.0, 0.01 * i, 0.0))) for i in range(1, 101)]
    for i in range(200):
        method.step(
            VehicleState(
                i * dt, path[i], (1.0 if i <= 100 else 0.0, 1.0 if i > 100 else 0.0, 0.0), LEVEL
            )
        )
    for vehicle in standing(path[200], LEVEL, dt, 2000):
        q_WS, _ = method.step(vehicle)
    assert off(q_WS, expected(exp((1.0, 0.0, 0.0)), 0.0)) < 1e-6


@pytest.mark.parametrize("row", TURNS, ids=lambda row: str(row["bank_deg"]))
def test_a_level_turn_is_felt_as_pinned(row: dict[str, float]) -> None:
    """Attitude-true means to hang in the seat by the bank, for as long as the turn lasts."""
    method = AttitudeRotation(1.0 / 60.0, AttitudeParameters())
    for vehicle in level_turn(radians(row["bank_deg"]), 100.0, 1.0 / 60.0, 1200):
        q_WS, _ = method.step(vehicle)
        assert felt(q_WS) == pytest.approx(row["attitude_true_felt"], abs=1e-6)
    off_by = angle_between(felt(q_WS), vehicle.f_B)
    assert np.degrees(off_by) == pytest.approx(row["attitude_true_direction_error_deg"], abs=1e-6)


@pytest.mark.parametrize("row", AT_REST, ids=lambda row: f"{row['theta_deg']},{row['phi_deg']}")
@pytest.mark.parametrize("heading", [0.0, 2.0])
def test_a_vehicle_at_rest_in_any_attitude_is_felt_as_pinned(
    row: dict[str, float], heading: float
) -> None:
    method = AttitudeRotation(0.01, AttitudeParameters())
    q = from_euler(heading, radians(row["theta_deg"]), radians(row["phi_deg"]))
    for vehicle in standing(q, LEVEL, 0.01, 50):
        assert felt(method.step(vehicle)[0]) == pytest.approx(row["felt"], abs=1e-9)


@pytest.mark.parametrize("late", [0.0, 0.5])
def test_rates_half_a_tick_off_the_attitude_leave_half_a_tick_of_turn(late: float) -> None:
    """JSBSim's attitude lags its rates: the error of a roll is dt/2 |w| at most, and goes."""
    dt, method, worst, q = (
        1.0 / 120.0,
        AttitudeRotation(1.0 / 120.0, AttitudeParameters()),
        0.0,
        IDENTITY,
    )
    for i in range(2400):
        w = 2.0 * np.sin(0.02 * i) ** 2 if i < 943 else 0.0
        q = exp((integral(0.02, 2.0, i - late), 0.0, 0.0))
        q_WS, _ = method.step(VehicleState(i * dt, q, (float(w), 0.0, 0.0), LEVEL))
        worst = max(worst, off(q_WS, expected(q, 0.0)))
    assert worst < 0.5 * dt * 2.0 * 2.0 * late + 1e-4
    assert off(q_WS, expected(q, 0.0)) < 1e-3


def integral(k: float, size: float, i: float, dt: float = 1.0 / 120.0) -> float:
    """Of size sin^2(k x) dt over x from 0 to i, at most 943."""
    x = min(max(i, 0.0), 943.0)
    return size * dt * (0.5 * x - np.sin(2.0 * k * x) / (4.0 * k))
