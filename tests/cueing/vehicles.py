"""Vehicles in closed form, for the cueing to follow, and wild ones."""

from collections.abc import Iterator
from math import cos, pi, sin, tan

from hypothesis import strategies as st

from atlas_cueing.rotation import Quat, Vec3, conjugate, exp, from_euler, multiply, rotate, scale
from atlas_cueing.signals import STANDARD_GRAVITY, VehicleState

LEVEL: Vec3 = (0.0, 0.0, -STANDARD_GRAVITY)
UP: Vec3 = (0.0, 0.0, 1.0)


def spinning(start: Quat, w_B: Vec3, dt: float, n: int) -> Iterator[VehicleState]:
    """A constant body rate, in free rotation about a point at rest: f turns with the body."""
    for i in range(n):
        q = multiply(start, exp(scale(i * dt, w_B)))
        yield VehicleState(i * dt, q, w_B, rotate(conjugate(q), LEVEL))


def standing(q: Quat, f_B: Vec3, dt: float, n: int, since: float = 0.0) -> Iterator[VehicleState]:
    """No rotation, a constant force."""
    return (VehicleState(since + i * dt, q, (0.0, 0.0, 0.0), f_B) for i in range(n))


def level_turn(bank: float, speed: float, dt: float, n: int) -> Iterator[VehicleState]:
    """A level coordinated turn with psi' = g tan(phi) / V.

    p = 0, q = psi' sin(phi), r = psi' cos(phi), f = (0, 0, -g / cos(phi)).
    """
    turn = STANDARD_GRAVITY * tan(bank) / speed
    w = (0.0, turn * sin(bank), turn * cos(bank))
    force = (0.0, 0.0, -STANDARD_GRAVITY / cos(bank))
    for i in range(n):
        yield VehicleState(i * dt, from_euler((i * dt * turn) % (2.0 * pi), 0.0, bank), w, force)


def manoeuvring(dt: float, seconds: float, push: float = 1.0) -> Iterator[VehicleState]:
    """Smooth turning about all Euler angles, its body rates, and a smooth force."""
    for i in range(round(seconds / dt) + 1):
        t = i * dt
        psi, theta, phi = 0.5 + 0.3 * t + 0.2 * sin(0.9 * t), 0.5 * sin(0.7 * t), 0.9 * sin(1.3 * t)
        psi_1, theta_1, phi_1 = 0.3 + 0.18 * cos(0.9 * t), 0.35 * cos(0.7 * t), 1.17 * cos(1.3 * t)
        p = phi_1 - psi_1 * sin(theta)
        q = theta_1 * cos(phi) + psi_1 * cos(theta) * sin(phi)
        r = psi_1 * cos(theta) * cos(phi) - theta_1 * sin(phi)
        force = (
            2.0 * push * sin(0.8 * t),
            1.5 * push * sin(1.1 * t),
            -9.8 - 4.0 * push * sin(0.6 * t),
        )
        yield VehicleState(t, from_euler(psi, theta, phi), (p, q, r), force)


def up_in_cabin(q_WS: Quat) -> Vec3:
    """Direction in which a rider at rest feels the force, in S."""
    return rotate(conjugate(q_WS), UP)


def _vectors(most: float) -> st.SearchStrategy[Vec3]:
    part = st.floats(-most, most) | st.sampled_from([0.0, -0.0, most, -most, 5e-324, 1e-12])
    return st.tuples(part, part, part)


def wild(force: float, rate: float) -> st.SearchStrategy[list[tuple[Quat, Vec3, Vec3]]]:
    """Attitudes, body rates (up to `rate` rad/s each) and forces (up to `force` m/s^2 each) that
    have nothing to do with each other nor with the ones before."""
    return st.lists(
        st.tuples(_vectors(3.0).map(exp), _vectors(rate), _vectors(force)), min_size=1, max_size=12
    )
