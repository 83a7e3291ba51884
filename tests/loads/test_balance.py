"""Second derivations of the loads: energy, momentum, invariance, other orders of arithmetic."""

from math import radians

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from atlas_cueing.errors import InputError
from atlas_cueing.loads import (
    LoadModel,
    Preload,
    WheelContact,
    balance,
    least_use_drive,
    platform_loads,
)
from atlas_cueing.loads.balance import required_wrench
from atlas_cueing.loads.reserve import static_torques, wheel_space_inertia

from .models import Platform, point_mass, random_body, random_states, ring

RNG = np.random.default_rng(19)
G = np.array([0.0, 0.0, -9.80665])


def model(wheels: tuple[WheelContact, ...] | None = None, **more: object) -> LoadModel:
    return LoadModel("x", 1.45, random_body(RNG), wheels or ring(3, radians(40.0)), **more)


def test_moment_and_force_are_those_of_many_mass_points() -> None:
    """The body as points: sum of m (r'' - g) and of r x m (r'' - g), r'' by the rigid motion."""
    points, masses = RNG.normal(size=(20, 3)) * 0.4, RNG.uniform(1.0, 9.0, 20)
    com = masses @ points / masses.sum()
    inertia = sum(
        m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(masses, points, strict=True)
    )
    body = type(point_mass())(masses.sum(), tuple(com), tuple(map(tuple, inertia)))
    states = random_states(RNG, 50)
    M, F = required_wrench(LoadModel("x", 1.0, body, ring(3, 0.7)), **states)
    for k in range(50):
        q, w, alpha, a = (value[k] for value in states.values())
        r = Rotation.from_quat(q, scalar_first=True).apply(points)
        push = masses[:, None] * (a - G + np.cross(alpha, r) + np.cross(w, np.cross(w, r)))
        np.testing.assert_allclose(F[k], push.sum(axis=0), rtol=1e-12, atol=1e-9)
        np.testing.assert_allclose(M[k], np.cross(r, push).sum(axis=0), rtol=1e-11, atol=1e-9)


@pytest.mark.parametrize("count", [3, 4, 6])
def test_forces_close_the_balance(count: int) -> None:
    made = model(ring(count, 0.6, 0.4), preloads=(Preload((0.0, 0.0, 1.0), 9e3),))
    states = random_states(RNG, 40)
    loads = balance(made, **states)
    drives = loads.drive[:, :, None] * made.V
    pushes = -loads.normal[:, :, None] * made.U + drives
    total = pushes.sum(axis=1) + np.array([0.0, 0.0, -9e3])
    assert np.all(loads.all_in_contact)
    np.testing.assert_allclose(total, loads.force, rtol=1e-10, atol=1e-6)
    about = np.cross(1.45 * made.U[None], pushes).sum(axis=1)
    np.testing.assert_allclose(about, loads.moment, rtol=1e-10, atol=1e-7)


def test_wheels_work_for_the_moment() -> None:
    """M . Omega = sum F_i V_i with the rim speeds V_i = r_i omega_i."""
    made, states = model(), random_states(RNG, 40)
    loads = balance(made, **states)
    np.testing.assert_allclose(
        np.sum(loads.moment * states["w_WS_W"], axis=1),
        np.sum(loads.drive * made.radius * loads.speed, axis=1),
        rtol=1e-10,
    )


def test_power_is_the_change_of_energy() -> None:
    """sum P = d/dt (kinetic energy about C) - Omega . m c x (g - a), by central differences."""
    wheels = tuple(
        WheelContact(w.contact, w.drive, w.radius, 0.5, inertia=0.4) for w in ring(3, 0.7)
    )
    made = model(wheels)
    q = Rotation.from_rotvec([0.3, -0.8, 0.5])
    w0, alpha, a, h = (
        np.array([1.0, -2.0, 0.7]),
        np.array([0.6, 0.3, -1.1]),
        np.array([1.0, 2.0, 3.0]),
        1e-5,
    )

    def energy(time: float) -> float:
        turn = Rotation.from_rotvec(w0 * time + alpha * time * time / 2)  # exact to time^3
        R = (turn * q).as_matrix()
        w = w0 + alpha * time
        speed = made.wheels_from_sphere @ w
        kinetic = 0.5 * w @ R @ np.array(made.body.inertia_S) @ R.T @ w
        return float(kinetic + 0.5 * made.wheel_inertia @ speed**2)

    loads = balance(made, q.as_quat(scalar_first=True)[None], w0[None], alpha[None], a[None])
    c = q.apply(made.body.com_S)
    slope = (energy(h) - energy(-h)) / (2.0 * h)
    work = slope - w0 @ (made.body.mass * np.cross(c, G - a))
    assert loads.power.sum() == pytest.approx(work, rel=1e-6)


def test_torque_at_rest_is_the_transposed_jacobian() -> None:
    made, states = model(ring(4, 0.6, 0.5)), random_states(RNG, 20)
    still = np.zeros((20, 3))
    loads = balance(made, states["q_WS"], still, still, still)
    np.testing.assert_allclose(
        loads.torque, static_torques(made, states["q_WS"]), rtol=1e-10, atol=1e-9
    )


def test_torque_is_the_wheel_space_inertia_times_acceleration() -> None:
    made, q = model(), random_states(RNG, 1)["q_WS"]
    alpha, still = np.array([[0.5, 2.0, -1.0]]), np.zeros((1, 3))
    moving, resting = (balance(made, q, still, x, still) for x in (alpha, still))
    H = wheel_space_inertia(made, q[0])
    np.testing.assert_allclose(
        moving.torque[0] - resting.torque[0], H @ moving.acceleration[0], rtol=1e-9
    )


def test_a_turn_about_the_vertical_changes_nothing() -> None:
    made, states = model(), random_states(RNG, 20)
    turn = Rotation.from_rotvec([0.0, 0.0, 1.1])
    turned = LoadModel(
        "x",
        1.45,
        made.body,
        tuple(
            WheelContact(tuple(turn.apply(w.contact)), tuple(turn.apply(w.drive)), w.radius, 0.5)
            for w in made.wheels
        ),
    )
    q = turn * Rotation.from_quat(states["q_WS"], scalar_first=True)
    vectors = (turn.apply(states[name]) for name in ("w_WS_W", "alpha_WS_W", "a_WS_W"))
    before, after = balance(made, **states), balance(turned, q.as_quat(scalar_first=True), *vectors)
    for name in ("drive", "normal", "torque", "power", "preload_needed"):
        np.testing.assert_allclose(
            getattr(after, name), getattr(before, name), rtol=1e-8, atol=1e-6
        )


def test_losses_brake() -> None:
    wheels = tuple(
        WheelContact(w.contact, w.drive, w.radius, 0.5, 0.0, 0.1, 2.0) for w in ring(3, 0.7)
    )
    bare, states = model(), random_states(RNG, 10)
    lossy = LoadModel("x", 1.45, bare.body, wheels)
    clean, braked = (
        balance(LoadModel("x", 1.45, bare.body, ring(3, 0.7)), **states),
        balance(lossy, **states),
    )
    np.testing.assert_allclose(
        braked.power - clean.power, 0.1 * clean.speed**2 + 2.0 * np.abs(clean.speed), rtol=1e-9
    )


def test_the_preload_needed_brings_the_largest_use_to_one() -> None:
    made, states = model(), random_states(RNG, 30)
    for k in range(30):
        state = {name: value[k : k + 1] for name, value in states.items()}
        needed = balance(made, **state).preload_needed[0]
        loaded = LoadModel("x", 1.45, made.body, made.wheels, (Preload((0.0, 0.0, 1.0), needed),))
        assert balance(loaded, **state).traction_use.max() == pytest.approx(1.0, rel=1e-9)


def test_two_wheels_in_one_place_share() -> None:
    three, states = model(), random_states(RNG, 10)
    six = LoadModel("x", 1.45, three.body, (*three.wheels, *three.wheels))
    one, both = balance(three, **states), balance(six, **states)
    np.testing.assert_allclose(both.drive[:, :3], 0.5 * one.drive, rtol=1e-9)
    np.testing.assert_allclose(both.normal[:, 3:], 0.5 * one.normal, rtol=1e-9)


def test_least_use_is_never_above_that_of_least_squares() -> None:
    made = model(ring(5, 0.5, 0.6), preloads=(Preload((0.0, 0.0, 1.0), 8e3),))
    states = random_states(RNG, 12)
    M, F = required_wrench(made, **states)
    drive = least_use_drive(made, M, F)
    np.testing.assert_allclose(1.45 * drive @ made.B, M, rtol=1e-9, atol=1e-7)

    def largest(split: np.ndarray) -> np.ndarray:
        need = F - split @ made.V - made.preload_W
        normal = -need @ made.normal_from_need.T
        return np.where(
            np.all(normal > 0, axis=1), np.max(np.abs(split) / (0.5 * normal), axis=1), np.inf
        )

    even, least = largest(M @ made.drive_from_moment.T), largest(drive)
    assert np.all(least <= even * (1.0 + 1e-9))
    assert np.median(least / even) < 0.97
    null = np.linalg.svd(made.B.T)[2][3:]  # no step along the null space is better
    for step in [*null, *-null, *(null[0] + null[1], null[0] - null[1])]:
        for size in (1e-2, 1.0, 30.0):
            assert np.all(largest(drive + size * step) >= least * (1.0 - 1e-9))


STATE = {"q_WS": [1, 0, 0, 0], "w_WS_W": [0, 0, 0], "alpha_WS_W": [0, 0, 0], "a_WS_W": [0, 0, 0]}


def test_shapes() -> None:
    platform = Platform(model(ring(4, 0.6)))
    one, many = platform_loads(platform, **STATE), platform_loads(platform, **random_states(RNG, 7))
    assert (one.moment.shape, one.normal.shape, one.preload_needed.shape) == ((3,), (4,), ())
    assert (many.moment.shape, many.normal.shape, many.support.shape) == ((7, 3), (7, 4), (7, 0))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"a_WS_W": [0, 0]}, "a_WS_W has shape"),
        ({"a_WS_W": [[0, 0, 0]]}, "a_WS_W has shape"),
        ({"w_WS_W": [0, float("nan"), 0]}, "w_WS_W has numbers that are not finite"),
        ({"q_WS": [2, 0, 0, 0]}, "normalise it"),
        ({"q_WS": 1.0}, "q_WS has shape"),
    ],
)
def test_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        platform_loads(Platform(model()), **(STATE | change))
