"""A plant from a platform file: its constants, and the state in which it stands at the start.

Derived here once more from the file's own numbers, apart from `loads` and `wheels`.
"""

from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..rotation import Mat3, Quat, Vec3, rotate
from ..rotations import Array
from ..scenario import Platform
from ..scenario.load_tables import DriveTable
from ..scenario.plant_table import PlantTable
from ..scenario.wheel_tables import WheelTable
from .passive_contacts import PassiveContact, PassiveContacts
from .plant_parts import PlantBody, PlantServo, PlantWheel
from .rolling_contact import Friction, RollingContact
from .sphere_on_wheels import (
    GRAVITY,
    LAG,
    OMEGA,
    SIZE,
    D,
    Q,
    SphereOnWheels,
    V,
    W,
    Z,
)

_ROUNDS = 50  # of Newton's method; contacts that open need some
_NO_LIMIT = 1e300  # N m


@dataclass(frozen=True)
class Start:
    """Motion at the start: q_WS, rate and angular acceleration (W), acceleration of the stage (W).

    torque: that the drives are given ahead, N m.
    """

    q_WS: Quat
    w_WS_W: Vec3
    alpha_WS_W: Vec3
    a_WS_W: Vec3
    torque: Vec3


@dataclass(frozen=True)
class PlantConstants:
    """The parts of the plant. B: induced rows (3, 3), W; radius: of each wheel, m."""

    body: PlantBody
    wheels: tuple[PlantWheel, ...]
    servo: PlantServo
    passive: PassiveContacts
    supports: tuple[PassiveContact, ...]
    table: PlantTable
    sphere_radius: float
    B: Array
    radius: Array

    @property
    def wheels_from_sphere(self) -> Array:
        """J^-1 (3, 3): wheel speeds that turn the sphere without slip (paper, Eq. 22)."""
        rows: Array = self.sphere_radius / self.radius[:, None] * self.B
        return rows

    def at(self, start: Start) -> SphereOnWheels:
        """The plant as it stands at the start: in balance, its wheels rolling with the sphere."""
        return SphereOnWheels(
            self.body, self.wheels, self.servo, self.passive, _balanced(self, start)
        )


def build_plant(platform: Platform, table: PlantTable | None = None) -> PlantConstants:
    """The plant of a platform. `table` replaces its `[plant]`.

    Raises InputError for a platform without masses, friction or inertia of its wheels, with another
    number of wheels than three, or whose contacts cannot hold the sphere.
    """
    _check(platform)
    table = table or platform.plant or PlantTable()
    body = _body(platform)
    stiffness = [
        *(wheel.stiffness_n_m or table.contact_stiffness_n_m for wheel in platform.wheel),
        *(support.stiffness_n_m for support in platform.support or ()),
    ]
    # the damping of a contact that makes the sphere as a whole damped by the ratio
    natural = np.sqrt(sum(stiffness) / (3.0 * body.mass))
    damping = [2.0 * table.contact_damping_ratio * k / float(natural) for k in stiffness]
    U, V_ = _directions(platform)
    B = np.cross(U, V_)
    radius = np.array([wheel.effective_radius_m for wheel in platform.wheel])
    wheels = tuple(
        _wheel(platform, i, table, U[i], V_[i], stiffness[i], damping[i]) for i in range(3)
    )
    supports = tuple(
        PassiveContact(_vector(_unit(s.contact)), k, c, s.preload_n)
        for s, k, c in zip(platform.support or (), stiffness[3:], damping[3:], strict=True)
    )
    push = -sum((p.force_n * _unit(p.contact) for p in platform.preload or ()), np.zeros(3))
    servo = _servo(platform, table, body, B, radius)
    return PlantConstants(
        body,
        wheels,
        servo,
        PassiveContacts(supports, _vector(push)),
        supports,
        table,
        platform.sphere.radius_m,
        B,
        radius,
    )


def _check(platform: Platform) -> None:
    if len(platform.wheel) != 3:
        raise InputError(
            f"platform {platform.name!r} has {len(platform.wheel)} wheels, allowed for a plant: 3"
        )
    platform.load_model()  # refuses masses, friction and contacts that hold nothing
    for k, wheel in enumerate(platform.wheel):
        if not wheel.load_contact(platform.drive or DriveTable()).inertia > 0.0:
            raise InputError(
                f"platform {platform.name!r}: wheel.{k}.inertia_kg_m2 is not given, allowed for a"
                " plant: inertia_kg_m2 > 0"
            )


def _body(platform: Platform) -> PlantBody:
    """Parts as one body about its own centre of mass."""
    parts = [part.part() for part in platform.part or ()]
    mass = sum(part.mass for part in parts)
    com = sum((part.mass * np.array(part.com_S) for part in parts), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for part in parts:
        r = np.array(part.com_S) - com
        inertia += np.array(part.inertia_S) + part.mass * (r @ r * np.eye(3) - np.outer(r, r))
    if not np.linalg.cond(inertia) < 1e9:
        raise InputError(
            f"platform {platform.name!r}: its parts have no moment of inertia about some axis,"
            " allowed for a plant: part.N.inertia_kg_m2 > 0 about every axis"
        )
    return PlantBody(mass, _vector(com), _matrix(inertia), _matrix(np.linalg.inv(inertia)))


def _directions(platform: Platform) -> tuple[Array, Array]:
    """Contacts and drives as unit vectors, the drive exactly tangent."""
    U = np.array([_unit(wheel.contact) for wheel in platform.wheel])
    drives = np.array([wheel.drive for wheel in platform.wheel])
    drives = drives - np.sum(drives * U, axis=1, keepdims=True) * U
    return U, drives / np.linalg.norm(drives, axis=1, keepdims=True)


def _wheel(
    platform: Platform, i: int, table: PlantTable, u: Array, v: Array, k: float, c: float
) -> PlantWheel:
    """A wheel with one row, or with the two that its file describes.

    Row s touches at cos beta u + s sin beta b, at the radius r - rho (1 - cos beta), with
    sin beta = offset / (R + rho).
    """
    file: WheelTable = platform.wheel[i]
    R, r, rows = platform.sphere.radius_m, file.effective_radius_m, file.rows
    friction = Friction(
        file.friction or 0.0,
        table.static_friction_ratio,
        table.stribeck_speed_m_s,
        table.bristle_stiffness_1_m,
        table.bristle_damping_s_m,
        table.creep_stiffness,
    )

    def contact(direction: Array, radius: float) -> RollingContact:
        """The wheel as it touches along `direction`."""
        return RollingContact(_vector(direction), _vector(v), radius, R, k, c, friction)

    if rows is None:
        return PlantWheel((contact(u, r),))
    sine = rows.offset / (R + rows.profile_radius)
    cosine, b = np.sqrt(1.0 - sine * sine), np.cross(u, v)
    radius = r - rows.profile_radius * (1.0 - float(cosine))
    both = tuple(contact(cosine * u + side * sine * b, radius) for side in (1.0, -1.0))
    return PlantWheel(both, 2.0 * pi / rows.rollers)


def _servo(
    platform: Platform, table: PlantTable, body: PlantBody, B: Array, radius: Array
) -> PlantServo:
    """Gains for the inertia that a wheel feels when the sphere turns with it."""
    drive = platform.drive or DriveTable()
    contact = platform.wheel[0].load_contact(drive)
    J = np.linalg.inv(B) @ np.diag(radius) / platform.sphere.radius_m
    felt = float(np.max(np.diag(J.T @ np.array(body.inertia_S) @ J))) + contact.inertia
    gain = table.servo_bandwidth_rad_s * felt
    return PlantServo(
        gain,
        gain * table.servo_angle_rate_1_s,
        drive.torque_n_m or _NO_LIMIT,
        contact.inertia,
        contact.viscous,
        contact.coulomb,
    )


def _balanced(plant: PlantConstants, start: Start) -> list[float]:
    """The state in which contacts give the body what the motion at the start needs.

    Raises InputError when no contacts can.
    """
    body, R = plant.body, _rotation(start.q_WS)
    w, alpha, a = (np.array(x) for x in (start.w_WS_W, start.alpha_WS_W, start.a_WS_W))
    c = R @ np.array(body.com_S)
    w_S, alpha_S = R.T @ w, R.T @ alpha
    inertia = np.array(body.inertia_S)
    about_com = R @ (inertia @ alpha_S + np.cross(w_S, inertia @ w_S))
    gravity = np.array([0.0, 0.0, -GRAVITY])
    force = body.mass * (a - gravity + np.cross(alpha, c) + np.cross(w, np.cross(w, c)))
    # M - c x F = I_c alpha + w x I_c w
    moment = about_com + np.cross(c, force)
    drive = np.linalg.solve(plant.sphere_radius * plant.B.T, moment)
    d, normal = _pressed_in(plant, force, drive)
    y = [0.0] * SIZE
    y[Q : Q + 4], y[W : W + 3], y[D : D + 3] = start.q_WS, w_S.tolist(), d.tolist()
    y[V : V + 3] = 0.0, 0.0, 0.0
    y[OMEGA : OMEGA + 3] = (plant.wheels_from_sphere @ w).tolist()
    for i in range(3):
        y[Z + i] = drive[i] / normal[i] / plant.table.bristle_stiffness_1_m
        if plant.servo.angle_gain > 0.0:
            lack = plant.radius[i] * drive[i] - start.torque[i]
            y[LAG + i] = float(lack) / plant.servo.angle_gain
    return [float(x) for x in y]


def _pressed_in(plant: PlantConstants, force: Array, drive: Array) -> tuple[Array, Array]:
    """Displacement d (m, W) and the wheels' normal forces (N) that hold the sphere."""
    rows = [wheel.touching(0.0) for wheel in plant.wheels]
    U = np.array([*(row.u for row in rows), *(s.contact for s in plant.supports)])
    k = np.array([*(row.stiffness for row in rows), *(s.stiffness for s in plant.supports)])
    n_0 = np.array([*(0.0 for _ in rows), *(s.unloaded for s in plant.supports)])
    push = np.array(plant.passive.preload) + drive @ np.array([row.v for row in rows]) - force
    d, touching = np.zeros(3), np.ones(len(k), bool)
    for _ in range(_ROUNDS):
        K = (U[touching] * k[touching, None]).T @ U[touching]
        if not np.linalg.cond(K) < 1e9:
            break
        d = np.linalg.solve(K, push - n_0[touching] @ U[touching])
        normal = n_0 + k * (U @ d)
        if np.array_equal(normal > 0.0, touching):
            if touching[:3].all():
                return d, normal[:3]
            break
        touching = normal > 0.0
    raise InputError(
        "the contacts cannot hold the sphere in the log's first state: a wheel lifts off; fly it on"
        " a platform with more preload"
    )


def _rotation(q: Quat) -> Array:
    """The matrix that turns S-vectors into W-vectors."""
    axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    return np.array([rotate(q, axis) for axis in axes]).T


def _unit(v: Vec3) -> Array:
    found: Array = np.array(v) / np.linalg.norm(v)
    return found


def _vector(v: NDArray[np.floating[Any]]) -> Vec3:
    x, y, z = v.tolist()
    return (x, y, z)


def _matrix(m: NDArray[np.floating[Any]]) -> Mat3:
    a, b, c = m
    return (_vector(a), _vector(b), _vector(c))
