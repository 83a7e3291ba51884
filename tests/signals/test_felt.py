"""What the head feels, against closed forms and scipy's rotations."""

import json
from math import cos, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from atlas_cueing.rotation import flip_rotation, from_euler
from atlas_cueing.signals import STANDARD_GRAVITY, direction_error, felt

ROWS = json.loads((Path(__file__).parent.parent / "oracles" / "felt_force.json").read_text())[
    "rows"
]
TURNS = [row for row in ROWS if row["case"] == "level coordinated turn"]
RESTS = [row for row in ROWS if row["case"] == "sphere at rest, stage at rest"]
ZERO = np.zeros((1, 3))
UPRIGHT = np.array([[1.0, 0.0, 0.0, 0.0]])

vectors = st.tuples(*[st.floats(-20.0, 20.0)] * 3).map(np.array)
rotations = st.tuples(*[st.floats(-3.0, 3.0)] * 3).map(Rotation.from_rotvec)


def at_rest(theta_deg: float, phi_deg: float) -> Any:
    """Specific force in a cabin held at this pitch and roll."""
    q_WS = flip_rotation(from_euler(0.0, radians(theta_deg), radians(phi_deg)))
    return felt([q_WS], ZERO, ZERO, ZERO, ZERO[0])[0][0]


def test_the_oracle_has_both_cases() -> None:
    assert len(TURNS) == 4
    assert len(RESTS) == 6


@pytest.mark.parametrize("row", RESTS)
def test_at_rest_at_any_attitude(row: dict[str, Any]) -> None:
    np.testing.assert_allclose(at_rest(row["theta_deg"], row["phi_deg"]), row["felt"], atol=1e-12)


@pytest.mark.parametrize("row", TURNS)
def test_level_turn_with_attitude_one_to_one_and_aligned_with_the_force(
    row: dict[str, Any],
) -> None:
    vehicle = np.array([row["vehicle_f"]])
    banked, aligned = at_rest(0.0, row["bank_deg"]), at_rest(0.0, 0.0)
    np.testing.assert_allclose(banked, row["attitude_true_felt"], atol=1e-12)
    np.testing.assert_allclose(aligned, row["force_aligned_felt"], atol=1e-12)
    banked_error, aligned_error = (
        np.degrees(direction_error(vehicle, [f])[0]) for f in (banked, aligned)
    )
    assert banked_error == pytest.approx(row["attitude_true_direction_error_deg"], abs=1e-12)
    assert aligned_error == pytest.approx(row["force_aligned_direction_error_deg"], abs=1e-12)


def test_stage_acceleration_is_felt_forward_right_and_down() -> None:
    force, _ = felt(UPRIGHT, ZERO, ZERO, [[1.0, 2.0, 3.0]], ZERO[0])
    np.testing.assert_allclose(force, [[1.0, -2.0, -3.0 - STANDARD_GRAVITY]])


def test_a_head_off_the_centre_feels_centripetal_and_tangential_acceleration() -> None:
    """A sphere at 2 rad/s and 3 rad/s^2 about z, the head half a metre ahead."""
    force, rate = felt(UPRIGHT, [[0.0, 0.0, 2.0]], [[0.0, 0.0, 3.0]], ZERO, [0.5, 0.0, 0.0])
    np.testing.assert_allclose(force, [[-4.0 * 0.5, -3.0 * 0.5, -STANDARD_GRAVITY]], atol=1e-12)
    np.testing.assert_allclose(rate, [[0.0, 0.0, -2.0]])


def test_rates_are_those_of_the_cabin() -> None:
    """Rolled right by 90 deg, a turn to the left is a turn nose down for the rider.

    Cabin y points down.
    """
    q_WS = flip_rotation(from_euler(0.0, 0.0, radians(90.0)))
    np.testing.assert_allclose(
        felt([q_WS], [[0.0, 0.0, 1.0]], ZERO, ZERO, ZERO[0])[1], [[0.0, -1.0, 0.0]], atol=1e-15
    )


@settings(deadline=None)
@given(rotations, vectors, vectors, vectors, vectors)
def test_felt_against_scipy(cabin: Rotation, w: Any, alpha: Any, a: Any, head: Any) -> None:
    r = cabin.apply(head)
    total = a + np.cross(alpha, r) + np.cross(w, np.cross(w, r)) + np.array([0.0, 0.0, 9.80665])
    force, rate = felt([cabin.as_quat(scalar_first=True)], [w], [alpha], [a], head)
    np.testing.assert_allclose(force[0], cabin.inv().apply(total) * [1.0, -1.0, -1.0], atol=1e-10)
    np.testing.assert_allclose(rate[0], cabin.inv().apply(w) * [1.0, -1.0, -1.0], atol=1e-12)


@settings(deadline=None)
@given(st.floats(0.0, np.pi), vectors, st.floats(0.1, 10.0))
def test_direction_error_is_the_angle_whatever_the_lengths(
    angle: float, axis: Any, length: float
) -> None:
    f = np.array([[0.0, 0.0, -9.8]])
    g = length * np.array([[sin(angle), 0.0, -cos(angle)]])
    turn = Rotation.from_rotvec(axis)
    assert direction_error(turn.apply(f), turn.apply(g))[0] == pytest.approx(angle, abs=1e-12)


def test_direction_error_of_no_force_is_zero() -> None:
    assert direction_error(ZERO, [[0.0, 0.0, -9.8]]).tolist() == [0.0]


def test_a_whole_run_is_its_ticks_one_by_one() -> None:
    """Columns cut out of a wider table, as a recorder has them, and one head for all."""
    random = np.random.default_rng(6)
    table = random.normal(size=(300, 20))
    q = Rotation.random(300, rng=random).as_quat(scalar_first=True)
    columns = (q, table[:, 1:4], table[:, 5:8], table[:, 9:12])
    head = (0.1, -0.2, 0.3)
    whole = felt(*columns, head)
    for k in (0, 137, 299):
        for run, tick in zip(
            whole, felt(*(column[k : k + 1] for column in columns), head), strict=True
        ):
            np.testing.assert_array_equal(run[k], tick[0])


def test_what_is_the_same_at_every_tick_may_be_given_once() -> None:
    """Many attitudes of a cabin that does not accelerate."""
    q = Rotation.random(20, rng=np.random.default_rng(7)).as_quat(scalar_first=True)
    many = np.zeros((20, 3))
    once = felt(q, ZERO, ZERO, ZERO, (0.1, 0.2, 0.3))
    np.testing.assert_array_equal(once[0], felt(q, many, many, many, (0.1, 0.2, 0.3))[0])


def test_no_ticks_feel_nothing() -> None:
    none = np.empty((0, 3))
    assert [x.shape for x in felt(np.empty((0, 4)), none, none, none, ZERO[0])] == [(0, 3), (0, 3)]
    assert direction_error(none, none).shape == (0,)
