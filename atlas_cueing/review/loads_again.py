"""Loads of a run, derived here again for review alone.

On purpose this shares nothing with `loads`: in W instead of S, with moments about the centre of
mass instead of the sphere's, and normal forces by the equations of least complementary energy with
multipliers, and non-negative least squares, instead of springs. Symbols as there.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..rotations import Array
from ..scenario import Platform
from .own_rotations import cross, to_matrix
from .recorded_run import RecordedRun

_GRAVITY_W = np.array([0.0, 0.0, -9.80665])
_BALANCE = 1e6  # weight of the balance of forces beside the springs
_ROUNDING = 1e-9  # of the forces: so little out of balance, or negative, is rounding
_BESIDE = 1e-7  # of the forces: so much out of balance is no equilibrium


@dataclass(frozen=True)
class LoadsAgain:
    """Loads of n ticks on N wheels.

    drive, normal (n, N), N; torque (n, N), N m; power (n, N), W. Where no push of the contacts
    holds the sphere, normal forces are those of contacts that can pull; they are NaN where it is a
    matter of rounding whether one does.
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
    forces = _least_energy(contacts, softness, held, push)
    if len(contacts) > 3:
        for k in np.flatnonzero(np.any(forces <= 0.0, axis=1)).tolist():
            opened = _with_open(contacts, softness, held, push[k])
            forces[k] = forces[k] if opened is None else opened
    return forces


def _least_energy(contacts: Array, softness: Array, held: Array, push: Array) -> Array:
    """Minimise sum (n - held)^2 softness / 2 with -sum n u = push (n, 3): forces (n, N).

    By the equations with multipliers; in the sense of least squares, as fewer than three contacts
    leave the sphere free to move, which changes no force.
    """
    soft, count = softness / float(np.mean(softness)), len(contacts)
    system = np.block([[np.diag(soft), -contacts], [contacts.T, np.zeros((3, 3))]])
    sides = np.hstack([np.tile(held * soft, (len(push), 1)), -push])
    solved: Array = np.linalg.lstsq(system, sides.T, rcond=None)[0].T[:, :count]
    return solved.astype(np.float64)


def _with_open(contacts: Array, softness: Array, held: Array, push: Array) -> Array | None:
    """The forces (N + M,) of least energy of which none is negative; None where no push holds.

    Which contacts push is found by non-negative least squares (Lawson & Hanson, Solving Least
    Squares Problems, 1974, chapter 23), the balance weighing most; how much, by the equations.
    NaN where rounding decides whether the sphere can be held, or which contacts push.
    """
    from scipy.optimize import nnls

    scale = float(np.abs(push).max() + held.max())
    missing = nnls(contacts.T, -push / scale)[1]  # how far the push is outside what contacts give
    if missing > _BESIDE:
        return None
    root = np.sqrt(softness / float(np.mean(softness)))
    weighed = np.vstack([np.diag(root), _BALANCE * contacts.T])
    found, _ = nnls(weighed, np.concatenate([root * held, -_BALANCE * push]) / scale)
    closed = found > 0.0
    forces = np.zeros(len(contacts))
    if np.any(closed):
        only = contacts[closed], softness[closed], held[closed], push[None]
        forces[closed] = _least_energy(*only)[0]
    balance = np.abs(forces @ contacts + push).max()
    if missing > _ROUNDING or balance > _ROUNDING * scale or forces.min() < -_ROUNDING * scale:
        return np.full(len(contacts), np.nan)
    return forces


def _unit(v: tuple[float, float, float] | Array) -> Array:
    unit: Array = np.array(v) / np.linalg.norm(v)
    return unit
