"""The free rigid body against Euler's equations integrated by scipy, and what it must keep."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from atlas_cueing.errors import InputError, VehicleError
from atlas_cueing.rotation import IDENTITY, Vec3, from_euler, rotate
from atlas_cueing.vehicles import RigidBodyFlight
from atlas_cueing.vehicles.euler_top import EulerTop

BODIES: list[tuple[Vec3, Vec3]] = [
    ((1.0, 2.0, 3.0), (0.3, 0.2, 1.0)),  # about the largest moment
    ((1.0, 2.0, 3.0), (1.0, 0.2, 0.3)),  # about the smallest
    ((3.0, 1.0, 2.0), (0.01, -0.02, -2.0)),  # beside the middle one: it flips
    ((2.0, 3.0, 1.0), (-1.0, 0.4, -0.7)),
    ((2.0, 1.0, 3.0), (0.5, -0.6, 0.7)),
    ((2.0, 2.0, 3.0), (0.5, 0.4, 1.0)),  # of two equal moments
    ((1.0, 3.0, 3.0), (0.5, 0.4, -1.0)),
    ((2.0, 2.0, 2.0), (0.5, 0.4, 1.0)),  # a ball
    ((1.0, 2.0, 3.0), (0.0, 1.0, 0.0)),  # steady about the middle axis
    ((1.0, 2.0, 3.0), (0.0, 0.0, 0.0)),
    ((1.0, 2.0, 2.9), (3.0, -2.0, 4.0)),
]


def separatrix() -> tuple[Vec3, Vec3]:
    """M^2 = 2E I2: it goes to the middle axis, and takes for ever."""
    return (1.0, 2.0, 3.0), (1.0, 0.5, float(np.sqrt(1.0 / 3.0)))


@pytest.mark.parametrize(("inertia", "w0"), [*BODIES, separatrix()])
def test_it_does_what_eulers_equations_say(inertia: Vec3, w0: Vec3) -> None:
    moments = np.array(inertia)

    def slope(_: float, y: np.ndarray) -> np.ndarray:
        q, w = y[:4], y[4:]
        turn = 0.5 * np.array(
            [
                -q[1] * w[0] - q[2] * w[1] - q[3] * w[2],
                q[0] * w[0] + q[2] * w[2] - q[3] * w[1],
                q[0] * w[1] + q[3] * w[0] - q[1] * w[2],
                q[0] * w[2] + q[1] * w[1] - q[2] * w[0],
            ]
        )
        return np.concatenate([turn, np.cross(moments * w, w) / moments])

    q0 = from_euler(0.3, -0.4, 0.5)
    times = np.linspace(0.0, 8.0, 81)
    true = solve_ivp(slope, (0.0, 8.0), [*q0, *w0], "DOP853", times, rtol=1e-12, atol=1e-13).y.T
    top = EulerTop(inertia, w0, q0)
    for t, (q, w) in zip(times, ((y[:4], y[4:]) for y in true), strict=True):
        assert np.abs(np.array(top.rates(t)) - w).max() < 1e-8
        ours = Rotation.from_quat(np.roll(top.attitude(t), -1))
        assert (ours.inv() * Rotation.from_quat(np.roll(q, -1))).magnitude() < 1e-8


@pytest.mark.parametrize(("inertia", "w0"), [BODIES[0], BODIES[2], BODIES[3]])
def test_energy_and_momentum_for_an_hour(inertia: Vec3, w0: Vec3) -> None:
    """Both to 1e-9, the momentum in space, by steps of half a second."""
    top, moments = EulerTop(inertia, w0, IDENTITY), np.array(inertia)
    w, q = np.array(w0), IDENTITY
    energy, momentum = float(np.sum(moments * w * w)), moments * w
    worst_energy = worst_momentum = 0.0
    for k in range(7201):
        time = 0.5 * k
        w, q = np.array(top.rates(time)), top.attitude(time)
        worst_energy = max(worst_energy, abs(float(np.sum(moments * w * w)) / energy - 1.0))
        here = np.array(rotate(q, tuple(moments * w)))
        off = float(np.linalg.norm(here - momentum) / np.linalg.norm(momentum))
        worst_momentum = max(worst_momentum, off)
    assert worst_energy < 1e-9
    assert worst_momentum < 1e-9


def test_the_attitude_does_not_drift_from_the_rates_in_an_hour() -> None:
    """The rate of the attitude, by differences, at the end of the hour."""
    inertia, w0 = BODIES[2]
    top = EulerTop(inertia, w0, IDENTITY)
    h = 1e-4
    top.attitude(3600.0)
    before, after = top.attitude(3600.0), top.attitude(3600.0 + h)
    turn = Rotation.from_quat(np.roll(before, -1)).inv() * Rotation.from_quat(np.roll(after, -1))
    assert np.abs(turn.as_rotvec() / h - np.array(top.rates(3600.0 + 0.5 * h))).max() < 1e-6


@pytest.mark.parametrize("free_fall", [True, False])
def test_what_the_rider_feels(free_fall: bool) -> None:
    """The second derivative of the seat's place in space, less gravity where the body is held."""
    inertia, w0 = BODIES[4]
    seat = (0.5, -1.0, 0.3)
    flight = RigidBodyFlight(inertia, w0, IDENTITY, seat, free_fall, 1000.0)
    vehicle = flight.vehicle()
    places, states = [], []
    for _ in range(400):
        places.append(rotate(vehicle.state.q_NB, seat))
        states.append(vehicle.state)
        assert vehicle.advance()
    acceleration = np.diff(np.array(places), 2, axis=0) * 1e6
    gravity = np.array([0.0, 0.0, 0.0 if free_fall else 9.80665])
    for a_N, state in zip(acceleration, states[1:-1], strict=True):
        felt_N = np.array(rotate(state.q_NB, state.f_B))
        assert np.abs(felt_N - (a_N - gravity)).max() < 1e-4


def test_what_is_no_body_or_no_ride() -> None:
    for inertia in ((1.0, 1.0, 2.5), (0.0, 1.0, 1.0), (1.0, float("inf"), 1.0)):
        with pytest.raises(InputError, match=r"rigid body: .*allowed: "):
            RigidBodyFlight(inertia, (0.0, 0.0, 1.0)).vehicle()
    with pytest.raises(VehicleError, match="body rate 60 rad/s"):
        RigidBodyFlight((1.0, 1.0, 2.0), (0.0, 0.0, 60.0)).vehicle()
    assert RigidBodyFlight((1.0, 1.0, 2.0), (0.0, 0.0, 1.0)).vehicle().dt == 1.0 / 120.0
