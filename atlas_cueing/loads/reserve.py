"""What a platform can do from rest before a wheel lifts, slips or lacks torque.

At rest in the upright attitude everything is linear in the sphere's acceleration alpha and in the
stage's a. Drive and normal force of a wheel are F_i = F_i0 + f_i . x and n_i = n_i0 + g_i . x with
x = alpha or a, so that no slip means, for both signs,

    (+-f_i - mu_i g_i) . x <= mu_i n_i0 -+ F_i0

a half-space each, as are |tau_i| <= tau_max and n_i >= 0. Along an axis the nearest plane in either
direction counts; about the worst axis of all, the nearest plane to the origin. Contacts are
bilateral here: supports that open are not followed.

Closed forms for wheels at elevation theta, centre of mass in the centre: n_i0 = m g / (3 sin
theta), lift-off at a = g / (2 tan theta).
"""

from dataclasses import dataclass

import numpy as np

from ..rotation import Vec3
from ..rotations import Array, rotate
from ..signals import STANDARD_GRAVITY
from .balance import Loads, balance, required_wrench
from .model import LoadModel
from .normal_forces import bilateral_forces

_UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])


@dataclass(frozen=True, slots=True)
class Reach:
    """A largest acceleration: along or about x, y, z of W alone, and the worst axis of all."""

    axes: Vec3
    worst: float


@dataclass(frozen=True, slots=True)
class Reserve:
    """What a platform can do from rest, upright.

    rest: its loads there. lift_off: acceleration of the stage, m/s^2, at which a wheel lifts, the
    centre of mass taken as in the sphere's centre; worst: the worst horizontal direction.
    by_traction, by_torque: angular acceleration of the sphere, rad/s^2; by_torque is None where
    the platform names no torque. preload_gain: normal force of each wheel for 1 N straight down.
    wheel_space_inertia: H (N, N), kg m^2.
    """

    rest: Loads
    lift_off: Reach
    by_traction: Reach
    by_torque: Reach | None
    preload_gain: Array
    wheel_space_inertia: Array


def reserve(model: LoadModel) -> Reserve:
    """Find what the platform can do from rest."""
    still = np.zeros((1, 3))
    torque = model.drive.torque
    return Reserve(
        rest=balance(model, _UPRIGHT[None], still, still, still).only(),
        lift_off=_lift_off(model),
        by_traction=_by_traction(model),
        by_torque=None if torque is None else _by_torque(model, torque),
        preload_gain=model.preload_gain,
        wheel_space_inertia=wheel_space_inertia(model, _UPRIGHT),
    )


def wheel_space_inertia(model: LoadModel, q_WS: Array) -> Array:
    """H (N, N), kg m^2, in the attitude q_WS (4,): tau = H omega' + ... (6).

    H = J^T I_W J + diag(J_i), I_W = R I R^T.
    """
    R_T = rotate(np.tile(q_WS, (3, 1)), np.eye(3))  # rows: the axes of S in W
    inertia = R_T.T @ np.array(model.body.inertia_S) @ R_T
    J = model.sphere_from_wheels
    H: Array = J.T @ inertia @ J + np.diag(model.wheel_inertia)
    return H


def static_torques(model: LoadModel, q_WS: Array) -> Array:
    """Torques (n, N), N m, that hold the sphere at rest in the attitudes q_WS (n, 4): J^T M (5)."""
    still = np.zeros((len(q_WS), 3))
    M, _ = required_wrench(model, q_WS, still, still, still)
    torques: Array = M @ model.sphere_from_wheels
    return torques


def _lift_off(model: LoadModel) -> Reach:
    """Lift-off of the stage; a force m (a - g) at the centre makes no moment."""
    mass, wheels = model.body.mass, len(model.wheels)
    a = np.vstack([np.zeros(3), np.eye(3)])
    force = mass * (a + np.array([0.0, 0.0, STANDARD_GRAVITY]))
    normal = bilateral_forces(model, force - model.preload_W)[:, :wheels]
    rows, room = (normal[0] - normal[1:]).T, normal[0]  # n_0 + g a >= 0
    horizontal = rows[:, :2]
    return Reach(_along_axes(rows, room), _nearest(horizontal, room))


def _states(model: LoadModel) -> tuple[Array, Array]:
    """Drive and normal forces (4, N) at rest, and with 1 rad/s^2 about x, y and z."""
    alpha = np.vstack([np.zeros(3), np.eye(3)])
    q, still = np.tile(_UPRIGHT, (4, 1)), np.zeros((4, 3))
    M, F = required_wrench(model, q, still, alpha, still)
    drive = M @ model.drive_from_moment.T
    need = F - drive @ model.V - model.preload_W
    return drive, bilateral_forces(model, need)[:, : len(model.wheels)]


def _by_traction(model: LoadModel) -> Reach:
    drive, normal = _states(model)
    grip = model.friction * normal
    f, g = (drive[1:] - drive[0]).T, (grip[1:] - grip[0]).T
    rows = np.vstack([f - g, -f - g])
    room = np.concatenate([grip[0] - drive[0], grip[0] + drive[0]])
    return Reach(_along_axes(rows, room), _nearest(rows, room))


def _by_torque(model: LoadModel, largest: float) -> Reach:
    drive, _ = _states(model)
    torque = model.radius * drive
    turning = model.wheel_inertia[:, None] * model.wheels_from_sphere
    rows = (torque[1:] - torque[0]).T + turning
    both = np.vstack([rows, -rows])
    room = np.concatenate([largest - torque[0], largest + torque[0]])
    return Reach(_along_axes(both, room), _nearest(both, room))


def _along_axes(rows: Array, room: Array) -> Vec3:
    """Largest x along or against each axis with rows x <= room; 0 where rest has no room."""
    x, y, z = (
        float(np.min(_ratio(np.maximum(room, 0.0), np.abs(rows[:, axis])))) for axis in range(3)
    )
    return (x, y, z)


def _nearest(rows: Array, room: Array) -> float:
    """Distance from the origin to the nearest plane rows x = room; 0 where rest has no room."""
    return float(np.min(_ratio(np.maximum(room, 0.0), np.linalg.norm(rows, axis=1))))


def _ratio(room: Array, slope: Array) -> Array:
    return np.where(slope > 1e-12, room / np.where(slope > 1e-12, slope, 1.0), np.inf)
