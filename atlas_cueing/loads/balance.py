"""Loads of a motion: moment, force, drive, normal and torque, power and traction (arrays).

Body of mass m, centre of mass c and inertia I about the sphere centre C, which the stage
accelerates with a; g = (0, 0, -9.80665) in W. What contacts have to put on the sphere, about C:

    M = I alpha + Omega x I Omega + m c x (a - g)                                              (1)
    F = m [a - g + alpha x c + Omega x (Omega x c)]                                            (2)

(Newton-Euler about a moving point.) Both are written in S, where I and c are constant, and turned
into W. Normal forces pass through C, so the drive forces alone make the moment:

    R B^T F_d = M,   for N > 3 the least sum of squares                                        (3)
    tau_i = r_i F_i + J_i omega_i' + b_i omega_i + tau_c sgn(omega_i),   P_i = tau_i omega_i   (4)

At rest r_i F_i = (J^T M)_i (5), the static Jacobian of Plumpton, Hayes, Langlois & Burlton.
No kinetic slip as long as every n_i > 0 and

    use_i = |F_i| / (mu_i n_i) <= 1                                                            (8)
    P = max_i (|F_i| / mu_i - n_i) / gain_i                                                    (9)

is the constant force straight down on the sphere that brings the largest use to 1; negative: a
reserve. gain_i is the normal force of wheel i for each N of it.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..rotations import Array, cross, rotate, rotate_back
from ..signals import STANDARD_GRAVITY
from .model import LoadModel
from .normal_forces import normal_forces

LARGEST_USE = 100.0
"""What a log has for a traction use beyond it, also where a wheel does not touch: any plot tool
takes it, and it is far beyond 1, at which the wheel slips."""


@dataclass(frozen=True, slots=True)
class Loads:
    """Loads of n states on N wheels and M supports; of one state without the first dimension.

    moment (n, 3), N m, and force (n, 3), N: what contacts put on the sphere, about its centre, W.
    drive (n, N), N: along the drive directions, on the sphere. normal (n, N), support (n, M), N:
    pushing is positive. speed, acceleration (n, N): of the wheels, rad/s and rad/s^2. torque
    (n, N), N m, power (n, N), W: at the axles, motoring is positive. traction_use (n, N): infinite
    where a wheel does not touch. all_in_contact (n,): whether no contact would have to pull.
    preload_needed (n,), N: straight down, beyond what is there; negative: a reserve.
    """

    moment: Array
    force: Array
    drive: Array
    normal: Array
    support: Array
    speed: Array
    acceleration: Array
    torque: Array
    power: Array
    traction_use: Array
    all_in_contact: NDArray[np.bool_]
    preload_needed: Array

    def only(self) -> "Loads":
        """The loads of the only state, without the first dimension."""
        return Loads(*(getattr(self, name)[0] for name in self.__slots__))


class HasLoads(Protocol):
    """A platform that knows what its loads depend on, such as `scenario.Platform`."""

    def load_model(self) -> LoadModel:
        """The model; raises InputError for a platform without masses."""


def platform_loads(
    platform: HasLoads,
    *,
    q_WS: ArrayLike,
    w_WS_W: ArrayLike,
    alpha_WS_W: ArrayLike,
    a_WS_W: ArrayLike,
) -> Loads:
    """Give the loads of one state, or of n states, by equations (1) to (4) and (7) to (9).

    Args:
        platform: with masses, as from `load_platform`.
        q_WS: unit quaternion (4,) or (n, 4), scalar first.
        w_WS_W: angular velocity (3,) or (n, 3), rad/s, W.
        alpha_WS_W: angular acceleration (3,) or (n, 3), rad/s^2, W.
        a_WS_W: acceleration of the sphere centre (3,) or (n, 3), m/s^2, W.

    Raises InputError for shapes that do not fit each other, numbers that are not finite, a
    quaternion that is not of unit norm, and a platform without masses.

    Example:
        >>> from atlas_cueing import load_platform, platform_loads
        >>> still = {"q_WS": [1, 0, 0, 0], "w_WS_W": [0, 0, 0], "alpha_WS_W": [0, 0, 0]}
        >>> loads = platform_loads(load_platform("atlas-2.9m"), **still, a_WS_W=[1, 0, 0])
        >>> round(float(loads.force[0]))  # N: a mass of 490 kg at 1 m/s^2
        490

    """
    model = platform.load_model()
    named = {"q_WS": q_WS, "w_WS_W": w_WS_W, "alpha_WS_W": alpha_WS_W, "a_WS_W": a_WS_W}
    states = {name: np.asarray(value, dtype=np.float64) for name, value in named.items()}
    one = states["q_WS"].ndim == 1
    _check_states(states)
    loads = balance(model, *(np.atleast_2d(state) for state in states.values()))
    return loads.only() if one else loads


def balance(
    model: LoadModel, q_WS: Array, w_WS_W: Array, alpha_WS_W: Array, a_WS_W: Array
) -> Loads:
    """Give the loads of n states; shapes and frames as for `platform_loads`."""
    M, F = required_wrench(model, q_WS, w_WS_W, alpha_WS_W, a_WS_W)
    return loads_of_wrench(model, M, F, M @ model.drive_from_moment.T, w_WS_W, alpha_WS_W)


def loads_of_wrench(
    model: LoadModel,
    moment_W: Array,
    force_W: Array,
    drive: Array,
    w_WS_W: Array,
    alpha_WS_W: Array,
) -> Loads:
    """Give the loads where moment, force and the split among the drives (n, N) are known."""
    wheels = len(model.wheels)
    need = force_W - drive @ model.V - model.preload_W  # (7)
    normals, in_contact = normal_forces(model, need)
    normal = normals[:, :wheels]
    speed = w_WS_W @ model.wheels_from_sphere.T
    acceleration = alpha_WS_W @ model.wheels_from_sphere.T
    torque = wheel_torques(model, drive, speed, acceleration)
    return Loads(
        moment_W,
        force_W,
        drive,
        normal,
        normals[:, wheels:],
        speed,
        acceleration,
        torque,
        torque * speed,
        traction_use(model, drive, normal),
        in_contact,
        preload_needed(model, drive, normal),
    )


def required_wrench(
    model: LoadModel, q_WS: Array, w_WS_W: Array, alpha_WS_W: Array, a_WS_W: Array
) -> tuple[Array, Array]:
    """Moment (n, 3), N m, and force (n, 3), N, on the sphere about its centre, W ((1), (2))."""
    m, c, inertia = model.body.mass, np.array(model.body.com_S), np.array(model.body.inertia_S)
    w, alpha = rotate_back(q_WS, w_WS_W), rotate_back(q_WS, alpha_WS_W)
    f = rotate_back(q_WS, a_WS_W + np.array([0.0, 0.0, STANDARD_GRAVITY]))  # (a - g) in S
    M = alpha @ inertia + cross(w, w @ inertia) + m * cross(c[None], f)
    F = m * (f + cross(alpha, c[None]) + cross(w, cross(w, c[None])))
    return rotate(q_WS, M), rotate(q_WS, F)


def wheel_torques(model: LoadModel, drive: Array, speed: Array, acceleration: Array) -> Array:
    """Torques at the axles (n, N), N m, by equation (4)."""
    torque: Array = (
        model.radius * drive
        + model.wheel_inertia * acceleration
        + model.viscous * speed
        + model.coulomb * np.sign(speed)
    )
    return torque


def traction_use(model: LoadModel, drive: Array, normal: Array) -> Array:
    """Share of the friction that each wheel uses (n, N), (8); infinite where it does not touch."""
    grip = model.friction * normal
    return np.where(grip > 0.0, np.abs(drive) / np.where(grip > 0.0, grip, 1.0), np.inf)


def preload_needed(model: LoadModel, drive: Array, normal: Array) -> Array:
    """Further force straight down (n,), N, with which the largest use is 1, by equation (9).

    Infinite where a wheel that slips is not loaded by it.
    """
    gain, missing = model.preload_gain, np.abs(drive) / model.friction - normal
    loaded = gain > 0.0
    needed = np.where(loaded, missing / np.where(loaded, gain, 1.0), -np.inf)
    needed = np.where(~loaded & (missing > 0.0), np.inf, needed)
    worst: Array = needed.max(axis=1)
    return worst


def _check_states(states: dict[str, Array]) -> None:
    q = states["q_WS"]
    for name, values in states.items():
        allowed = (*q.shape[:-1], 4 if name == "q_WS" else 3)
        if values.ndim not in (1, 2) or values.shape != allowed:
            raise InputError(f"{name} has shape {values.shape}, allowed: {allowed}, as q_WS")
        if not np.all(np.isfinite(values)):
            raise InputError(f"{name} has numbers that are not finite, allowed: finite numbers")
    off = float(np.abs(np.sum(q * q, axis=-1) - 1.0).max(initial=0.0))
    if off > 1e-6:
        raise InputError(f"q_WS: | |q|^2 - 1 | = {off:.3g}, allowed: at most 1e-6; normalise it")
