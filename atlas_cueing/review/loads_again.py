"""Loads of a run, derived here again for review alone.

On purpose this shares nothing with `loads`: in W instead of S, with moments about the centre of
mass instead of the sphere's, and normal forces by the equations of least complementary energy with
multipliers instead of springs. Symbols as there.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..rotations import Array
from ..scenario import Platform
from .own_rotations import cross, to_matrix
from .recorded_run import RecordedRun

_GRAVITY_W = np.array([0.0, 0.0, -9.80665])
_MOST_OPENED = 100


@dataclass(frozen=True)
class LoadsAgain:
    """Loads of n ticks on N wheels.

    drive, normal (n, N), N; torque (n, N), N m; power (n, N), W. A normal force is NaN where
    contacts open and no equilibrium was found.
    """

    drive: Array
    normal: Array
    torque: Array
    power: Array
    friction: Array

    @cached_property
    def use(self) -> Array:
        """Traction use (n, N), 100 at most and where a wheel does not touch."""
        with np.errstate(all="ignore"):
            use = np.where(
                self.normal > 0.0, np.abs(self.drive / self.friction / self.normal), 100.0
            )
        return np.minimum(use, 100.0)


def loads_again(run: RecordedRun) -> LoadsAgain:
    """Derive the loads of a run from its logged motion and its platform's file."""
    platform, flight = run.platform, run.flight
    contact, drive_way, radius = _wheels(platform)
    moment, force = _wrench(run)
    arms = platform.sphere.radius_m * np.cross(contact, drive_way)  # moment of 1 N of each drive
    drive: Array = np.linalg.lstsq(arms.T, moment.T, rcond=None)[0].T.astype(np.float64)
    preloads = [(p.contact, p.force_n) for p in platform.preload or ()]
    pushed = sum((-size * _unit(way) for way, size in preloads), np.zeros(3))
    # what the normal forces have to push the sphere with
    push = force - drive @ drive_way - pushed
    normal = _normal_forces(platform, contact, push)[:, : len(contact)]
    table = platform.drive
    gear, rotor = ((table.gear or 1.0), (table.motor_inertia_kg_m2 or 0.0)) if table else (1.0, 0.0)
    inertia = np.array([(w.inertia_kg_m2 or 0.0) + gear * gear * rotor for w in platform.wheel])
    viscous = (table.viscous_n_m_s or 0.0) if table else 0.0
    coulomb = (table.coulomb_n_m or 0.0) if table else 0.0
    speed = flight.motion_w_W @ arms.T / radius
    change = flight.motion_alpha_W @ arms.T / radius
    losses = viscous * speed + coulomb * np.sign(speed)
    torque = drive * radius + inertia * change + losses
    friction = np.array([wheel.friction or 0.0 for wheel in platform.wheel])
    return LoadsAgain(drive, normal, torque, torque * speed, friction)


def _wheels(platform: Platform) -> tuple[Array, Array, Array]:
    """Contacts and drives (N, 3) as unit vectors, and effective radii (N,)."""
    contacts, drives, radii = [], [], []
    for wheel in platform.wheel:
        u = _unit(wheel.contact)
        v = _unit(np.array(wheel.drive) - np.dot(wheel.drive, u) * u)
        contacts.append(u)
        drives.append(v)
        radii.append(wheel.radius_m * np.cos(np.radians(wheel.roller_deg or 0.0)))
    return np.array(contacts), np.array(drives), np.array(radii)


def _wrench(run: RecordedRun) -> tuple[Array, Array]:
    """Moment about the centre and force (n, 3), W: by Newton and Euler about the centre of mass.

    F = m (r'' - g) and M = I_c alpha + Omega x I_c Omega + c x F, with c in W and
    r'' = a + alpha x c + Omega x (Omega x c).
    """
    parts, flight = run.platform.part or (), run.flight
    mass = sum(part.mass_kg for part in parts)
    com = sum((part.mass_kg * np.array(part.com_m) for part in parts), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for part in parts:
        xx, yy, zz, xy, xz, yz = (*part.inertia_kg_m2, 0.0, 0.0, 0.0)[:6]
        away = np.array(part.com_m) - com
        skew = np.array([[0, -away[2], away[1]], [away[2], 0, -away[0]], [-away[1], away[0], 0]])
        inertia += [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] - part.mass_kg * skew @ skew
    R = to_matrix(flight.motion_q_WS)
    w, alpha, c = flight.motion_w_W, flight.motion_alpha_W, R @ com
    I_W = R @ inertia @ np.swapaxes(R, 1, 2)
    acceleration = flight.motion_a_W + cross(alpha, c) + cross(w, cross(w, c))
    force = mass * (acceleration - _GRAVITY_W)
    spin = np.einsum("nij,nj->ni", I_W, alpha) + cross(w, np.einsum("nij,nj->ni", I_W, w))
    return spin + cross(c, force), force


def _normal_forces(platform: Platform, wheels: Array, push: Array) -> Array:
    """Normal forces (n, N + M) of wheels and supports that push the sphere with (n, 3)."""
    supports = platform.support or ()
    contacts = np.array([*wheels, *(_unit(each.contact) for each in supports)])
    softness = 1.0 / np.array(
        [
            *(wheel.stiffness_n_m or 1.0 for wheel in platform.wheel),
            *(each.stiffness_n_m for each in supports),
        ]
    )
    held = np.array([0.0] * len(wheels) + [each.preload_n for each in supports])
    closed = np.ones(len(contacts), np.bool_)
    forces, _ = _least_energy(contacts, softness, held, closed, push)
    if len(contacts) > 3:
        for k in np.flatnonzero(np.any(forces <= 0.0, axis=1)).tolist():
            forces[k] = _with_open(contacts, softness, held, push[k], forces[k])
    return forces


def _least_energy(
    contacts: Array, softness: Array, held: Array, closed: NDArray[np.bool_], push: Array
) -> tuple[Array, Array]:
    """Minimise sum (n - held)^2 softness / 2 of the closed contacts, -sum n u = push (n, 3).

    Returns the forces (n, N + M), and the multipliers (n, 3): the displacement of the sphere.
    """
    U, soft, count = contacts[closed], softness[closed], int(closed.sum())
    scale = float(np.mean(soft))
    system = np.block([[np.diag(soft / scale), -U], [U.T, np.zeros((3, 3))]])
    sides = np.hstack([np.tile(held[closed] * soft / scale, (len(push), 1)), -push])
    solved = np.linalg.solve(system, sides.T).T
    forces = np.zeros((len(push), len(contacts)))
    forces[:, closed] = solved[:, :count]
    return forces, solved[:, count:] * scale


def _with_open(
    contacts: Array, softness: Array, held: Array, push: Array, bilateral: Array
) -> Array:
    """Open the contact that pulls most, again and again; NaN if that ends in no equilibrium.

    Without any equilibrium at all the log has the bilateral forces; they are given where opening
    leaves fewer than three contacts.
    """
    closed = np.ones(len(contacts), np.bool_)
    forces, moved = bilateral, np.zeros(3)
    for _ in range(_MOST_OPENED):
        if forces[closed].min() >= 0.0:
            gap = held + (contacts @ moved) / softness
            fair = bool(np.all(gap[~closed] <= 1e-6 * np.abs(forces).max()))
            return forces if fair else np.full(len(contacts), np.nan)
        closed[np.flatnonzero(closed)[int(np.argmin(forces[closed]))]] = False
        if closed.sum() < 3 or np.linalg.cond(contacts[closed]) > 1e6:
            return np.full(len(contacts), np.nan)
        solved, multipliers = _least_energy(contacts, softness, held, closed, push[None])
        forces, moved = solved[0], multipliers[0]
    return np.full(len(contacts), np.nan)


def _unit(v: tuple[float, float, float] | Array) -> Array:
    unit: Array = np.array(v) / np.linalg.norm(v)
    return unit
