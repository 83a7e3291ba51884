"""Wheels with two rows of rollers: which row touches changes the Jacobian.

Row s = +1 or -1 lies at s d along the axle b = u x v. A roller's profile is an arc of radius rho,
so the row is a torus about the axle, and it touches the sphere where both have a common normal:

    sin beta = d / (R + rho)
    u_s = cos beta u + s sin beta b     contact
    b_s = u_s x v = cos beta b - s sin beta u     induced row
    r_c = r - rho (1 - cos beta)     radius at the contact                                    (10)

With the rows s of all wheels, R B_s Omega = diag(r_c) omega, so that

    Omega = C_s J omega,   C_s = B_s^-1 diag(r_c / r) B                                       (11)

Eight constant matrices for three wheels (least squares for more): what a single-row model leaves
out. To first order
C_s - 1 = beta B^-1 diag(s) U; their mean is 1 + O(beta^2). That the offset between the rows is a
significant error of the sphere's angular velocity, and an augmented Jacobian for it, is due to
Weiss, Langlois & Hayes, Mech. Mach. Theory 44(2), 2009; the derivation here is our own.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import asin, cos, pi, sin, tau

import numpy as np

from ..errors import SlipConditionError
from ..rotation import add, scale
from ..rotations import Array, accumulated, exp, geodesic
from .geometry import LARGEST_CONDITION_NUMBER, Geometry, OmniWheel

_AXES = 24  # of turns over which ripple and drift are taken, spread evenly over the sphere
_STEPS = 4096  # a turn; rows change at most some hundred times


@dataclass(frozen=True, slots=True)
class RollerRows:
    """Two rows of rollers of one wheel.

    offset: of each row from the wheel's middle along the axle, m; profile_radius: of a roller's
    profile, m; rollers: in each row.
    """

    offset: float
    profile_radius: float
    rollers: int


def tilt(sphere_radius: float, rows: RollerRows) -> float:
    """Angle beta (rad) between the wheel's middle and the contact of a row (10)."""
    return asin(rows.offset / (sphere_radius + rows.profile_radius))


def row_contact(sphere_radius: float, wheel: OmniWheel, rows: RollerRows, side: int) -> OmniWheel:
    """The wheel as the row on `side` (+1 or -1) of it touches: contact, drive, radius (10)."""
    beta = tilt(sphere_radius, rows)
    u, b = wheel.contact, wheel.induced
    contact = add(scale(cos(beta), u), scale(side * sin(beta), b))
    return OmniWheel(contact, wheel.drive, wheel.radius - rows.profile_radius * (1.0 - cos(beta)))


def row_correction(geometry: Geometry, rows: Sequence[RollerRows], sides: Sequence[int]) -> Array:
    """C_s (3, 3), with which Omega = C_s J omega when the rows `sides` touch (11).

    rows, sides: of each wheel. Raises SlipConditionError for a singular geometry.
    """
    radius = geometry.sphere_radius
    touching = [
        row_contact(radius, wheel, each, side)
        for wheel, each, side in zip(geometry.wheels, rows, sides, strict=True)
    ]
    B = np.array(geometry.induced_rows)
    B_s = np.array([wheel.induced for wheel in touching])
    if not np.linalg.cond(B_s) <= LARGEST_CONDITION_NUMBER:
        raise SlipConditionError(
            geometry.name,
            float(np.sqrt(max(np.linalg.det(B_s.T @ B_s), 0.0))),
            float(np.linalg.cond(B_s)),
            LARGEST_CONDITION_NUMBER,
        )
    ratio = [
        touch.radius / wheel.radius for touch, wheel in zip(touching, geometry.wheels, strict=True)
    ]
    correction: Array = np.linalg.lstsq(B_s, np.array(ratio)[:, None] * B, rcond=None)[0]
    return correction.astype(np.float64)


def row_corrections(geometry: Geometry, rows: Sequence[RollerRows]) -> dict[tuple[int, ...], Array]:
    """C_s of all combinations of rows (11), by the sides of the wheels, +1 or -1 each."""
    return {
        sides: row_correction(geometry, rows, sides)
        for sides in product((1, -1), repeat=len(geometry.wheels))
    }


@dataclass(frozen=True, slots=True)
class RowEffect:
    """What two rows of rollers do to a sphere that is driven as if there was one.

    tilt: beta of each wheel, rad. largest_correction: largest |C_s - 1| (2-norm). mean_correction:
    |mean C_s - 1|. ripple: rms of |(C_s - 1) Omega| / |Omega| over turns about 24 axes. drift_mean,
    drift_max: orientation error after a full turn about them, rad, the rollers of all wheels in
    phase at the start.
    """

    tilt: tuple[float, ...]
    largest_correction: float
    mean_correction: float
    ripple: float
    drift_mean: float
    drift_max: float


def row_effect(geometry: Geometry, rows: Sequence[RollerRows]) -> RowEffect:
    """Find ripple and drift of wheels with two rows, by turning the sphere about many axes."""
    corrections = row_corrections(geometry, rows)
    errors = [matrix - np.eye(3) for matrix in corrections.values()]
    ripples, drifts = zip(
        *(_turn(geometry, rows, corrections, axis) for axis in _spread(_AXES)), strict=True
    )
    return RowEffect(
        tilt=tuple(tilt(geometry.sphere_radius, each) for each in rows),
        largest_correction=max(float(np.linalg.norm(error, 2)) for error in errors),
        mean_correction=float(np.linalg.norm(np.mean(errors, axis=0), 2)),
        ripple=float(np.sqrt(np.mean(np.square(ripples)))),
        drift_mean=float(np.mean(drifts)),
        drift_max=max(drifts),
    )


def _turn(
    geometry: Geometry,
    rows: Sequence[RollerRows],
    corrections: dict[tuple[int, ...], Array],
    axis: Array,
) -> tuple[float, float]:
    """Ripple (rms, relative) and drift (rad) of one turn about `axis` (W)."""
    angle = tau * (np.arange(_STEPS) + 0.5) / _STEPS  # of the sphere, as commanded
    wheel = angle[:, None] * (np.array(geometry.wheels_from_sphere) @ axis)
    phase = wheel * np.array([each.rollers for each in rows]) / tau  # in roller pitches
    sides = np.where(np.floor(2.0 * phase) % 2 == 0, 1, -1)  # rows touch by turns
    rates = {side: matrix @ axis for side, matrix in corrections.items()}
    w = np.array([rates[tuple(side)] for side in sides.tolist()])
    ripple = float(np.sqrt(np.mean(np.sum((w - axis) ** 2, axis=1))))
    flown = accumulated(np.array([1.0, 0.0, 0.0, 0.0]), exp(tau / _STEPS * w))[-1:]
    return ripple, float(geodesic(flown, exp(tau * axis[None]))[0])


def _spread(count: int) -> Array:
    """Unit vectors (count, 3) spread evenly over the sphere (Fibonacci lattice)."""
    k = np.arange(count) + 0.5
    z, azimuth = 1.0 - 2.0 * k / count, pi * (1.0 + 5.0**0.5) * k
    return np.stack(
        [np.sqrt(1.0 - z * z) * np.cos(azimuth), np.sqrt(1.0 - z * z) * np.sin(azimuth), z], axis=1
    )
