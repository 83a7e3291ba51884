"""Everything the loads of a platform depend on, with the constant matrices of the equations.

| symbol | here | shape |
|---|---|---|
| u_i, v_i | rows of `U`, `V` | (N, 3), W |
| b_i = u_i x v_i (paper, Eq. 11) | rows of `B` | (N, 3), W |
| u_j of wheels, then supports | rows of `all_contacts` | (N + M, 3), W |
"""

from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np

from ..errors import InputError
from ..rotation import Mat3, Vec3
from ..rotations import Array, cross
from ..signals import STANDARD_GRAVITY
from .body import Body
from .contact import UNLIMITED, Drive, Preload, Support, WheelContact
from .kept_rows import KeptRows
from .tick_loads import WheelLoads

LARGEST_CONDITION_NUMBER = 1e6
"""Of the contacts' stiffness (sum k u u^T): beyond it the weight has no three independent
directions to go, and of the drives' rows: beyond it no drive can turn the sphere."""


@dataclass(frozen=True)
class LoadModel:
    """A sphere of `sphere_radius` (m) with its body and all that touches it; `name` for messages.

    wheels: three or more. traction_margin: reserve of friction that a motion should keep.
    traction_finding: whether slip and lift-off are findings, or remarks. traction_kept: whether
    smoothing keeps traction with the margin, and torques.
    """

    name: str
    sphere_radius: float
    body: Body
    wheels: tuple[WheelContact, ...]
    preloads: tuple[Preload, ...] = ()
    supports: tuple[Support, ...] = ()
    drive: Drive = UNLIMITED
    traction_margin: float = 1.25
    traction_finding: bool = False
    traction_kept: bool = False

    def check(self) -> None:
        """Refuse what has no definite loads.

        Raises InputError when the drives cannot turn the sphere about every axis, or the contacts
        cannot hold a force along every axis.
        """
        _check_condition(self.name, "the wheels' induced rows", self.B)
        weighted = np.sqrt(self.stiffness)[:, None] * self.all_contacts
        _check_condition(self.name, "the contacts of wheels and supports", weighted)

    @cached_property
    def U(self) -> Array:
        """Contacts of the wheels (N, 3), W."""
        return np.array([wheel.contact for wheel in self.wheels])

    @cached_property
    def V(self) -> Array:
        """Drive directions (N, 3), W."""
        return np.array([wheel.drive for wheel in self.wheels])

    @cached_property
    def B(self) -> Array:
        """Induced rows (N, 3), W: b_i = u_i x v_i."""
        return cross(self.U, self.V)

    @cached_property
    def radius(self) -> Array:
        """Effective wheel radii (N,), m."""
        return np.array([wheel.radius for wheel in self.wheels])

    @cached_property
    def friction(self) -> Array:
        """Friction coefficients (N,)."""
        return np.array([wheel.friction for wheel in self.wheels])

    @cached_property
    def wheel_inertia(self) -> Array:
        """Inertia at each axle (N,), kg m^2."""
        return np.array([wheel.inertia for wheel in self.wheels])

    @cached_property
    def viscous(self) -> Array:
        """Viscous losses at each axle (N,), N m s."""
        return np.array([wheel.viscous for wheel in self.wheels])

    @cached_property
    def coulomb(self) -> Array:
        """Coulomb losses at each axle (N,), N m."""
        return np.array([wheel.coulomb for wheel in self.wheels])

    @cached_property
    def wheels_from_sphere(self) -> Array:
        """J^-1 (N, 3): wheel speeds from the sphere's rate (paper, Eq. 22)."""
        rows: Array = self.sphere_radius / self.radius[:, None] * self.B
        return rows

    @cached_property
    def sphere_from_wheels(self) -> Array:
        """J (3, N) = B^+ diag(r) / R, the inverse of `wheels_from_sphere` (Eq. 18).

        For N > 3 it is a left inverse: that one whose transpose gives the torques of the least
        drive forces, r F_d = J^T M (5).
        """
        inverse: Array = self.drive_from_moment.T * self.radius
        return inverse

    @cached_property
    def drive_from_moment(self) -> Array:
        """(R B^T)^+ (N, 3): the least drive forces that make a moment (equation 3)."""
        inverse: Array = np.linalg.pinv(self.sphere_radius * self.B.T).astype(np.float64)
        return inverse

    @cached_property
    def preload_W(self) -> Array:
        """What all constant preloads push the sphere with (3,), N, W."""
        return -sum((p.force * np.array(p.contact) for p in self.preloads), np.zeros(3))

    @property
    def _touching(self) -> list[WheelContact | Support]:
        return [*self.wheels, *self.supports]

    @cached_property
    def all_contacts(self) -> Array:
        """Contacts of the wheels and then of the supports (N + M, 3), W."""
        return np.array([each.contact for each in self._touching])

    @cached_property
    def stiffness(self) -> Array:
        """Stiffness of wheels and supports (N + M,), N/m."""
        return np.array([each.stiffness for each in self._touching])

    @cached_property
    def unloaded(self) -> Array:
        """Forces of wheels and supports with the sphere in its place (N + M,), N."""
        return np.array([0.0] * len(self.wheels) + [each.preload for each in self.supports])

    @cached_property
    def normal_from_need(self) -> Array:
        """Bilateral normal forces from what they have to push with (N + M, 3).

        n = n_0 + k U K^-1 (push - ...), K = sum k u u^T (see `normal_forces`).
        """
        weighted = self.stiffness[:, None] * self.all_contacts
        forces = np.linalg.solve(self.all_contacts.T @ weighted, weighted.T)
        return forces.T.astype(np.float64)

    @cached_property
    def preload_gain(self) -> Array:
        """Normal force of each wheel for 1 N that pushes the sphere straight down (N,).

        For three wheels at elevation theta: 1 / (3 sin theta).
        """
        gain: Array = -self.normal_from_need[: len(self.wheels), 2]
        return gain

    def per_tick(self) -> WheelLoads:
        """The loads of three wheels tick by tick. Raises InputError for any other number."""
        if len(self.wheels) != 3:
            raise InputError(
                f"platform {self.name!r} has {len(self.wheels)} wheels, allowed in a loop: 3"
            )
        rows = self.normal_from_need[:3]
        rest = self.unloaded[:3] + rows @ (self.preload_W - self.unloaded @ self.all_contacts)
        return WheelLoads(
            mass=self.body.mass,
            com_S=self.body.com_S,
            inertia_S=self.body.inertia_S,
            drive_from_moment=_matrix(self.drive_from_moment),
            force_from_drive=_matrix(self.V.T),
            normal_from_push=_matrix(rows),
            normal_at_rest=_vector(rest),
            radius=_vector(self.radius),
            inertia=_vector(self.wheel_inertia),
            viscous=_vector(self.viscous),
            coulomb=_vector(self.coulomb),
            friction=_vector(self.friction),
        )

    def kept_rows(self) -> KeptRows:
        """What a motion of three wheels has to keep. Raises InputError for any other number."""
        loads = self.per_tick()
        middle, spread = _moments(np.array(self.body.inertia_S))
        rows, supports = self.normal_from_need[:3], self.normal_from_need[3:]
        offset = self.preload_W - self.unloaded @ self.all_contacts
        rest = self.unloaded + self.normal_from_need @ offset
        weight = np.array([0.0, 0.0, self.body.mass * STANDARD_GRAVITY])
        of_drive = self.V.T @ self.drive_from_moment
        return KeptRows(
            loads=loads,
            inertia_middle=middle,
            inertia_spread=spread,
            sphere_from_wheels=_matrix(self.sphere_from_wheels),
            normal_from_moment=_matrix(rows @ of_drive),
            grip=_vector(self.friction / self.traction_margin),
            standing=_vector((rest - self.normal_from_need @ weight)[:3]),
            torque=inf if self.drive.torque is None else self.drive.torque,
            supports=[
                (_vector(row @ of_drive), _vector(row), float(alone))
                for row, alone in zip(supports, rest[3:], strict=True)
            ],
        )


def _moments(inertia: Array) -> tuple[float, float]:
    """Middle of the principal moments, and half of their spread, kg m^2."""
    moments = np.linalg.eigvalsh(inertia)
    low, high = float(moments[0]), float(moments[-1])
    return 0.5 * (low + high), 0.5 * (high - low)


def _vector(v: Array) -> Vec3:
    x, y, z = v.tolist()
    return (x, y, z)


def _matrix(m: Array) -> Mat3:
    a, b, c = m
    return (_vector(a), _vector(b), _vector(c))


def _check_condition(name: str, what: str, rows: Array) -> None:
    condition = float(np.linalg.cond(rows))
    if not condition <= LARGEST_CONDITION_NUMBER:
        raise InputError(
            f"platform {name!r}: {what} are not independent along all three axes: condition number"
            f" {condition:.3g}, allowed: at most {LARGEST_CONDITION_NUMBER:g}; move a contact"
        )
